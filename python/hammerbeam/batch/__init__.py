"""A table of parameters times a study: many ordinary studies, each in a folder of its own.

    from hammerbeam import batch

    table = batch.Parameters.grid({"stop.stop.gap_m": [0.8, 1.0, 1.2]})
    gaps = batch.Batch.plan("gaps", "studies/impact-oscillator.toml", table)
    gaps.run()
    print(gaps.gather().frame())

Items run on all cores of this machine, on HyperQueue, on Dask or as an array of Slurm;
`docs/how-to/many-studies.md` has what a batch folder holds.

| file | what it does |
|---|---|
| `_parameters.py` | tables of parameters: CSV, grid, Latin hypercube |
| `_task.py` | what is computed of each item, by parts where that is possible |
| `_folder.py` | the files of a batch folder and of an item |
| `_item.py` | computing one item; what a report holds |
| `_batch.py` | planning, status, running what is missing |
| `_local.py`, `_hyperqueue.py`, `_dask.py`, `_slurm.py` | engines, and the script for Slurm |
| `_gather.py` | one table and one figure of all items |
| `__main__.py` | `python -m hammerbeam.batch`, which engines call |
"""

from ._batch import Batch, Engine
from ._dask import Dask
from ._folder import Counts, Status
from ._gather import Gathered
from ._hyperqueue import HyperQueue
from ._local import Local
from ._parameters import Parameters
from ._slurm import slurm_script
from ._task import Task

__all__ = [
    "Batch",
    "Counts",
    "Dask",
    "Engine",
    "Gathered",
    "HyperQueue",
    "Local",
    "Parameters",
    "Status",
    "Task",
    "slurm_script",
]
