"""Runs the cells of every notebook in examples/notebooks, one after the other in one namespace; their asserts are the test."""

import contextlib
import io
import json
import pathlib
import unittest

NOTEBOOKS = sorted((pathlib.Path(__file__).parents[2] / "examples" / "notebooks").glob("*.ipynb"))


class Notebooks(unittest.TestCase):
    def test_their_cells_run(self):
        self.assertEqual([path.name for path in NOTEBOOKS], ["cs184.ipynb", "fit_stiffness.ipynb"])
        for path in NOTEBOOKS:
            with self.subTest(notebook=path.name):
                names, printed, checks = {"__name__": "__main__"}, io.StringIO(), 0
                for number, cell in enumerate(json.loads(path.read_text(encoding="utf-8"))["cells"]):
                    if cell["cell_type"] != "code":
                        continue
                    self.assertEqual(cell["outputs"], [], "a notebook is kept without outputs")
                    text = "".join(cell["source"])
                    checks += text.count("assert ")
                    with contextlib.redirect_stdout(printed):
                        exec(compile(text, f"{path.name}, cell {number}", "exec"), names)
                self.assertGreater(checks, 1)
                self.assertGreater(len(printed.getvalue().splitlines()), 3)


if __name__ == "__main__":
    unittest.main()
