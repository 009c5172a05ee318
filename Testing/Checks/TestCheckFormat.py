"""check_format.py passes a formatted tree, fails on another one, and skips where clang-format is of another version."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import check_format

SCRIPT = pathlib.Path(check_format.__file__)
RULES = (SCRIPT.parents[2] / ".clang-format").read_text()


class CheckFormat(unittest.TestCase):
    def checked(self, source, *program):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / ".clang-format").write_text(RULES)
            (root / "Filters").mkdir()
            (root / "Filters" / "One.cxx").write_text(source)
            return subprocess.run([sys.executable, "-B", str(SCRIPT), folder, *program], capture_output=True, text=True,
                                  check=False)

    @unittest.skipUnless(check_format.version_of("clang-format") == check_format.VERSION, "needs Debian 12's clang-format")
    def test_formatted_and_not(self):
        self.assertEqual(self.checked("int one = 1;\n").returncode, 0)
        wrong = self.checked("int one=1;\n")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("One.cxx:1", wrong.stderr)

    def test_without_a_program(self):
        skipped = self.checked("int one=1;\n", "/nowhere/clang-format")
        self.assertEqual(skipped.returncode, check_format.SKIPPED)
        self.assertIn("/nowhere/clang-format does not run", skipped.stdout)

    def test_another_version(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "clang-format"
            program.write_text("#!/bin/sh\necho clang-format version 19.1.7\n")
            program.chmod(0o755)
            skipped = self.checked("int one=1;\n", str(program))
        self.assertEqual(skipped.returncode, check_format.SKIPPED)
        self.assertIn("this is version 19", skipped.stdout)


if __name__ == "__main__":
    unittest.main()
