"""A line whose value is no number somewhere is told with its places, and what rests on it is not told as well."""

import pytest
from as_script import as_script

from mechsheet.document.numberless import numberless
from tests.own_worksheet import own


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        ("y = sqrt(-g.F)  # [-] root", ""),  # Python's own root raises, and the line is told so
        ("y = np.sqrt(-g.F)  # [-] root\nz = 2 * y  # [-] twice", "y: no number"),
        ("y = np.log(x - 1)  # [-] logarithm\nz = y + x  # [-] sum", "y: no number at 1 of 5 places: 1"),
        (
            "y = (x - x[2]) / (x - x[2])  # [-] none by none\nz = np.cumsum(y)  # [-] sum",
            "y: no number at 1 of 5 places: 3",
        ),
        ("y = np.sqrt(x - 9)  # [-] root", "y: no number at 5 of 5 places: 1, 2, 3, 4, …"),
        ("y = np.where(x < 1, np.nan, 1) + 1j  # [-] point", "y: no number at 1 of 5 places: 1"),
        ("y = np.sqrt(np.outer(x - 1, x))  # [-] table", "y: no number at 5 of 25 places: 1 1, 1 2, 1 3, 1 4, …"),
        ("f = lambda t: np.sqrt(t)  # [-] root\ny = f(x - 1)  # [-] of all", "y: no number at 1 of 5 places: 1"),
        ("y = x / (x - x[0])  # [-] infinite\nz = 1 / y  # [-] zero", ""),
    ],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_the_first_line_without_a_number_is_told_with_its_places(tmp_path, lines, told):
    sheet = own(tmp_path, lines)
    try:
        names = sheet.run(sheet.results, {"g": sheet.inputs()})
    except ValueError:
        assert not told
        return
    found = [f"{line.name}: {where}" for line, where in numberless({**names, "__file__": sheet.path})]
    assert found == [told] * bool(told)


def test_a_script_tells_it_and_numpys_warning_in_a_line_each(tmp_path):
    sheet = own(tmp_path, "y = np.sqrt(x - 1)  # [-] root\nz = g.F / (x - x[0])  # [-] quotient")
    done = as_script(sheet.path)
    assert "= np.sqrt(x - 1): no number at 1 of 5 places: 1\n" in done.stdout and done.returncode == 0
    warned = done.stderr.splitlines()
    assert len(warned) == 2 and all(text.startswith("own.py, line ") for text in warned)
    assert sum(text.endswith("z = g.F / (x - x[0]): divide by zero encountered in divide") for text in warned) == 1
