"""`cmake --install` gives others a core to link: the example builds against it, and every header compiles with it.

The build tree is named by the environment variable TESSERA_BUILD, the compiler and its flags by CXX and CXXFLAGS.
"""
import os
import pathlib
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as xml

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = os.environ['TESSERA_BUILD']

HEADERS_PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(headers LANGUAGES CXX)
find_package(Tessera REQUIRED)
add_library(headers OBJECT headers.cpp)
target_link_libraries(headers PRIVATE Tessera::job Tessera::gpu)
"""


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, timeout=600)
    if done.returncode != 0:
        raise AssertionError(f'{command}\n{done.stdout.decode()}\n{done.stderr.decode()}')
    return done.stdout.decode()


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix='tessera-install-')
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.prefix = cls.folder / 'prefix'
        run('cmake', '--install', BUILD, '--prefix', cls.prefix)

    def build(self, source):
        build = self.folder / f'build-{source.name}'
        run('cmake', '-G', 'Ninja', '-S', source, '-B', build, f'-DCMAKE_PREFIX_PATH={self.prefix}')
        run('cmake', '--build', build)
        return build

    def test_example_paves_a_disc(self):
        printed = run(self.build(ROOT / 'examples/link-core') / 'link_core')
        colours = {element.get('fill') for element in xml.fromstring(printed).iter() if element.get('fill')}
        self.assertGreaterEqual(len(colours), 2, printed[:1000])
        self.assertGreater(printed.count('<path') + printed.count('<polygon'), 100)

    def test_every_header_compiles(self):
        headers = sorted(str(path.relative_to(self.prefix / 'include')) for path in self.prefix.rglob('*.h'))
        self.assertIn('tessera/job/job.h', headers)
        self.assertIn('tessera/gpu/gl_rasterizer.h', headers)
        source = self.folder / 'headers'
        source.mkdir()
        (source / 'CMakeLists.txt').write_text(HEADERS_PROJECT)
        (source / 'headers.cpp').write_text(''.join(f'#include "{header}"\n' for header in headers))
        self.build(source)

    def test_no_path_of_the_build_is_left(self):
        for path in self.prefix.rglob('*.cmake'):
            text = path.read_text()
            for other in [str(ROOT), BUILD, '/usr/']:
                self.assertNotIn(other, text, path)

    def test_program_tells_the_version(self):
        version = (ROOT / 'VERSION').read_text().strip()
        self.assertEqual(run(self.prefix / 'bin/tessera', '--version'), f'tessera {version}\n')
        self.assertIn(f'"tessera {version}"', (self.prefix / 'share/man/man1/tessera.1').read_text())
        self.assertIn(f'set(PACKAGE_VERSION "{version}")', 
                      next(self.prefix.rglob('TesseraConfigVersion.cmake')).read_text())


if __name__ == '__main__':
    unittest.main()
