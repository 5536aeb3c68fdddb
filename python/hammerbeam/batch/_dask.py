"""Dask: clusters of its own, or on Slurm, PBS and others through `dask-jobqueue`."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .. import _check
from .._tables import needed

if TYPE_CHECKING:
    from ._batch import Batch


class Dask:
    """Workers of a Dask cluster, each item a task of one thread.

    Workers need Hammerbeam and the batch folder under the same path.

    * `client`: a `distributed.Client`.
    """

    def __init__(self, client: Any) -> None:
        if not all(hasattr(client, name) for name in ("map", "cancel")):
            raise _check.refused("client", client, "must be a distributed.Client")
        self.client = client

    def compute(self, batch: "Batch", numbers: Sequence[int]) -> None:
        """Has items computed; Dask gives those of a worker that ends to others."""
        distributed = needed("distributed", "dask")
        folder = str(batch.folder)
        # The same item may be asked for again: it is no pure function of its number.
        tasks = self.client.map(_compute, [folder] * len(numbers), list(numbers), pure=False, retries=1)
        try:
            distributed.wait(tasks)
        finally:
            self.client.cancel(tasks)


def _compute(folder: str, number: int) -> str:
    from ._batch import Batch

    return Batch(folder).compute(number).value
