"""What is made from the program's own description of its parameters is what the program says today."""
import os
import pathlib
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = os.environ['TESSERA']


class DocsUpToDate(unittest.TestCase):
    def test_parameter_reference(self):
        said = subprocess.run([PROGRAM, 'schema', '--markdown'], check=True, capture_output=True).stdout.decode()
        written = (ROOT / 'docs/parameters.md').read_text(encoding='utf-8')
        self.assertTrue(said == written, 'out of date: tessera schema --markdown >docs/parameters.md')


if __name__ == '__main__':
    unittest.main()
