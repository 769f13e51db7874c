"""One version everywhere: that of the file VERSION."""
import json
import pathlib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]


class Version(unittest.TestCase):
    def test_is_that_of_every_package(self):
        version = (ROOT / 'VERSION').read_text(encoding='utf-8').strip()
        for folder in ['.', 'web/package']:
            package = json.loads((ROOT / folder / 'package.json').read_text(encoding='utf-8'))
            self.assertEqual(package['version'], version, folder)


if __name__ == '__main__':
    unittest.main()
