"""Tables of parameters: grids, samples, files."""

import hammerbeam
import numpy as np
import pytest
from hammerbeam.batch import Parameters

GAP = "stop.stop.gap_m"


def test_a_grid_is_all_combinations() -> None:
    table = Parameters.grid({"a.b": [1, 2.5], "c": ["x", "2 mm"]})
    assert table.rows == [("1", "x"), ("1", "2 mm"), ("2.5", "x"), ("2.5", "2 mm")]
    assert table.column("a.b").tolist() == [1.0, 1.0, 2.5, 2.5]


def test_a_latin_hypercube_has_each_part_of_every_range_once() -> None:
    table = Parameters.latin_hypercube({"a": (0.0, 1.0), "b": (-2.0, 2.0)}, 50, seed=7)
    parts = np.floor(50 * table.column("a")), np.floor(50 * (table.column("b") + 2) / 4)
    assert all(sorted(part) == list(range(50)) for part in parts)
    assert list(parts[0]) != list(parts[1])
    assert table.rows == Parameters.latin_hypercube({"a": (0.0, 1.0), "b": (-2.0, 2.0)}, 50, seed=7).rows
    assert table.rows != Parameters.latin_hypercube({"a": (0.0, 1.0), "b": (-2.0, 2.0)}, 50, seed=8).rows


def test_a_table_is_read_as_it_is_written() -> None:
    table = Parameters.parse(f'{GAP}, excitation.frequency_hz\n0.9, "[0.1, 0.2]"\n 1 mm ,"[0.1, 0.3]"\n')
    assert table.rows == [("0.9", "[0.1, 0.2]"), ("1 mm", "[0.1, 0.3]")]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "is empty"),
        ("a\n", "has no row"),
        ("a,a\n1,2\n", "the same key"),
        ("a,b\n1\n", "has 1 values"),
        ("a,\n1,2\n", "a column without a key"),
        ('a\n" "\n', "no value"),
    ],
)
def test_tables_that_make_no_sense_are_refused(text: str, words: str) -> None:
    with pytest.raises(hammerbeam.BadInput, match=words):
        Parameters.parse(text)
