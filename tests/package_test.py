"""cpack makes Debian packages with everything in its place. The build tree is named by TESSERA_BUILD.

scripts/test-package installs them on a bare Debian.
"""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = pathlib.Path(os.environ['TESSERA_BUILD'])
VERSION = (ROOT / 'VERSION').read_text(encoding='utf-8').strip()


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, timeout=600).stdout.decode()


@unittest.skipUnless(shutil.which('dpkg-deb') and shutil.which('dpkg-shlibdeps'), 'there is no dpkg')
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix='tessera-package-')
        cls.addClassCleanup(folder.cleanup)
        run('cpack', '-G', 'DEB', '--config', BUILD / 'CPackConfig.cmake', '-B', folder.name)
        architecture = run('dpkg', '--print-architecture').strip()
        cls.paths = {name: pathlib.Path(folder.name, f'{name}_{VERSION}_{architecture}.deb')
                     for name in ['tessera', 'libtessera-dev']}

    def field(self, package, name):
        return run('dpkg-deb', '--field', self.paths[package], name).strip()

    def files(self, package):
        lines = [line.split(None, 5) for line in run('dpkg-deb', '--contents', self.paths[package]).splitlines()]
        for mode, owner, *_, path in lines:
            self.assertEqual(owner, 'root/root', path)
            self.assertEqual(mode[1:], 'rwxr-xr-x' if mode[0] == 'd' or '/bin/' in path else 'rw-r--r--', path)
        return {path.removeprefix('.') for mode, *_, path in lines if mode[0] != 'd'}

    def test_control_fields(self):
        for package in self.paths:
            self.assertEqual(self.field(package, 'Version'), VERSION)
            self.assertTrue(self.field(package, 'Description').startswith('Turns pictures into pieces'))
            self.assertIn('@', self.field(package, 'Maintainer'))

    def test_program_depends_on_what_it_loads(self):
        depends = self.field('tessera', 'Depends')
        for library in ['libc6 (>=', 'libopencv-core', 'libopencv-imgproc', 'libpng16', 'libtiff', 'libwebp', 'libssl', 'libegl1']:
            self.assertIn(library, depends)
        self.assertNotIn('-dev', depends)

    def test_core_depends_on_what_its_config_looks_for(self):
        """The packages are those that scripts/setup installs for the same names, after THIRD_PARTY.md."""
        packages = self.field('libtessera-dev', 'Depends').split(', ')
        table = (ROOT / 'THIRD_PARTY.md').read_text(encoding='utf-8')
        config = (ROOT / 'packaging/TesseraConfig.cmake.in').read_text(encoding='utf-8')
        sought = [line.split('(')[1].split()[0].strip(')') for line in config.splitlines()
                  if line.startswith('find_dependency(')]
        self.assertGreater(len(sought), 4)
        for name in sought:
            row = next(line for line in table.splitlines() if f'| `{name}`' in line)
            self.assertTrue(any(f'`{package}`' in row for package in packages), name)

    def test_files_of_the_program(self):
        self.assertEqual(self.files('tessera'), {
            '/usr/bin/tessera', '/usr/share/man/man1/tessera.1', '/usr/share/bash-completion/completions/tessera',
            '/usr/share/zsh/vendor-completions/_tessera', '/usr/share/fish/vendor_completions.d/tessera.fish',
            *(f'/usr/share/doc/tessera/{name}' for name in ['copyright', 'CHANGELOG.md', 'README.md', 'THIRD_PARTY.md', 'parameters.md'])})

    def test_files_of_the_core(self):
        files = self.files('libtessera-dev')
        folders = {path.name for path in (ROOT / 'core').iterdir() if path.is_dir()}
        self.assertEqual({path for path in files if path.endswith('.a')}, {f'/usr/lib/libtessera_{name}.a' for name in folders})
        for path in ['/usr/include/tessera/job/job.h', '/usr/lib/cmake/Tessera/TesseraConfig.cmake', '/usr/share/doc/libtessera-dev/copyright']:
            self.assertIn(path, files)
        self.assertFalse([path for path in files if path.endswith('.cpp') and '/examples/' not in path])


if __name__ == '__main__':
    unittest.main()
