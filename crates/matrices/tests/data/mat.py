"""Writes plain.mat and compressed.mat beside itself: a sparse and a full matrix, and a text between them."""

from pathlib import Path

import numpy
import scipy.io
import scipy.sparse

STIFFNESS = scipy.sparse.csc_matrix([[4.0, -1.5, 0.0], [-1.5, 6.0, 0.25], [0.0, 0.25, 7.0]])
VARIABLES = {"K": STIFFNESS, "about": "three masses", "M": numpy.diag([2.0, 3.0, 1e-3])}

for name, compressed in (("plain", False), ("compressed", True)):
    file = Path(__file__).parent / f"{name}.mat"
    scipy.io.savemat(file, VARIABLES, do_compression=compressed)
    # The header has the date and the machine.
    file.write_bytes(b"MATLAB 5.0 MAT-file".ljust(116) + file.read_bytes()[116:])
