"""One version everywhere: that of the file VERSION."""
import json
import pathlib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]


VERSION = (ROOT / 'VERSION').read_text(encoding='utf-8').strip()


def read_json(path):
    return json.loads((ROOT / path).read_text(encoding='utf-8'))


class Version(unittest.TestCase):
    """CMake reads VERSION; install_test.py and package_test.py look at what comes of it."""

    def test_is_that_of_every_npm_package(self):
        for folder in ['.', 'web/package']:
            self.assertEqual(read_json(f'{folder}/package.json')['version'], VERSION, folder)
        for folder in ['', 'web/package']:
            self.assertEqual(read_json('package-lock.json')['packages'][folder]['version'], VERSION, folder)

    def test_nobody_else_names_it(self):
        """What is built takes it from VERSION."""
        for path in [ROOT / 'CMakeLists.txt', *(path for folder in ['cmake', 'core', 'native', 'packaging', 'scripts', 'examples', 'web/wasm']
                                                for path in sorted((ROOT / folder).rglob('*')))]:
            if path.is_file() and path.suffix not in {'.png', '.jpg', '.pyc'}:
                code = [line for line in path.read_text(encoding='utf-8').splitlines() if not line.lstrip().startswith(('#', '//'))]
                self.assertNotIn(VERSION, '\n'.join(code), path)

    def test_is_in_the_changelog(self):
        headings = [line for line in (ROOT / 'CHANGELOG.md').read_text(encoding='utf-8').splitlines() if line.startswith('## ')]
        self.assertTrue(any(VERSION in heading for heading in headings[:2]), 'Unreleased, or the latest release')


if __name__ == '__main__':
    unittest.main()
