"""THIRD_PARTY.md names every library that is looked for, included or installed, and permissive licences only."""
import json
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
PERMISSIVE = {'Apache-2.0', 'BSD-2-Clause', 'BSD-3-Clause', 'BSL-1.0', 'CC0-1.0', 'Hershey', 'IJG', 'ISC', 'MIT', 'Zlib', 'libpng-2.0',
              'libtiff'}
OF_TOOLS = PERMISSIVE | {'0BSD', 'MPL-2.0', 'Python-2.0'}  # of which nothing is in what is built
REGISTRY = 'https://registry.npmjs.org/'
CMAKE_OWN = {'PkgConfig', 'Python3'}  # tools rather than libraries
SYSTEM_HEADERS = re.compile(r'sys/.*|dlfcn\.h|unistd\.h|fcntl\.h|poll\.h|malloc\.h')
OWN_CMAKE_MODULES = re.compile(r'Find\w+\.cmake')

FOUND = re.compile(r'\bfind_package\(\s*([\w-]+)')
MODULES = re.compile(r'\bpkg_check_modules\(\s*\w+((?:\s+[\w.-]+)+)')
LIBRARY = re.compile(r'\bfind_library\(\s*\w+\s+(?:NAMES\s+)?([\w-]+)')
HEADER = re.compile(r'\bfind_path\(\s*\w+\s+([\w./-]+)')
INCLUDE = re.compile(r'^\s*#\s*include\s*<([^>]+)>', re.MULTILINE)


def stem(header):
    """opencv2/core.hpp -> opencv2, zlib.h -> zlib.h"""
    return header.split('/')[0]


def asked_by_cmake(text):
    text = re.sub(r'#[^\n]*', '', text)
    words = {word for modules in MODULES.findall(text) for word in modules.split()} - {'REQUIRED', 'IMPORTED_TARGET'}
    return words | (set(FOUND.findall(text)) - CMAKE_OWN) | set(LIBRARY.findall(text)) | {
        stem(header) for header in HEADER.findall(text)}


def asked_by_code(text):
    """Headers of the standard library have neither folder nor extension."""
    return {stem(header) for header in INCLUDE.findall(text)
            if re.search(r'[./]', header) and not SYSTEM_HEADERS.fullmatch(header)}


def files(*endings):
    for folder in ['cmake', 'core', 'native', 'web/wasm', 'tests', 'bench']:
        yield from (path for path in sorted((ROOT / folder).rglob('*')) if path.name.endswith(endings))


def asked_by_npm():
    asked = set()
    for folder in ['.', 'web/package']:
        package = json.loads((ROOT / folder / 'package.json').read_text(encoding='utf-8'))
        asked |= set(package.get('dependencies', {})) | set(package.get('devDependencies', {}))
    return asked


def asked_by_tree():
    asked = asked_by_npm() | asked_by_cmake((ROOT / 'CMakeLists.txt').read_text(encoding='utf-8'))
    for path in files('CMakeLists.txt', '.cmake'):
        if not OWN_CMAKE_MODULES.fullmatch(path.name):
            asked |= asked_by_cmake(path.read_text(encoding='utf-8'))
    for path in files('.h', '.cpp'):
        asked |= asked_by_code(path.read_text(encoding='utf-8'))
    return asked


def tables(text):
    """Rows of the tables as {column: cell}."""
    rows, columns = [], None
    for line in text.splitlines():
        if not line.startswith('|'):
            columns = None
            continue
        cells = [cell.strip() for cell in line.strip('|').split('|')]
        if columns is None:
            columns = cells
        elif not set(line) <= set('|-'):
            rows.append(dict(zip(columns, cells, strict=True)))
    return rows


def words_in(rows, column):
    return {word for row in rows for word in re.findall(r'`([^`]+)`', row.get(column, ''))}


def installed_packages():
    setup = (ROOT / 'scripts/setup').read_text(encoding='utf-8')
    return set(re.search(r'^packages=\((.*?)\)', setup, re.MULTILINE | re.DOTALL)[1].split())


def is_debian(release):
    name = pathlib.Path('/etc/os-release')
    lines = name.read_text(encoding='utf-8').splitlines() if name.exists() else []
    return 'ID=debian' in lines and f'VERSION_ID="{release}"' in lines


def version_of_package(name):
    """As upstream has it: 1:1.2.13.dfsg-1 -> 1.2.13.dfsg; empty where it is not installed."""
    answer = subprocess.run(['dpkg-query', '-W', '-f', '${db:Status-Status} ${source:Upstream-Version}', name],
                            capture_output=True, text=True, check=False).stdout
    status, _, version = answer.partition(' ')
    return version if status == 'installed' else ''


class ThirdParty(unittest.TestCase):
    def setUp(self):
        self.rows = tables((ROOT / 'THIRD_PARTY.md').read_text(encoding='utf-8'))

    def test_names_what_is_asked_for_and_nothing_else(self):
        compilers_own = {'emscripten', 'emscripten.h'}  # headers that come with it
        self.assertEqual(words_in(self.rows, 'Found as'), asked_by_tree() - compilers_own)

    def test_names_what_is_installed_and_nothing_else(self):
        self.assertEqual(words_in(self.rows, 'Packages'), installed_packages())

    def test_licences_are_permissive(self):
        libraries = [row for row in self.rows if 'Library' in row]
        self.assertTrue(libraries)
        for row in libraries:
            self.assertTrue(row['Version'] and row['What for'], row['Library'])
            self.assertLessEqual(set(row['Licence'].split(', ')), PERMISSIVE, row['Library'])


def locked():
    """What npm installs, by folder; packages of this repository are links."""
    lock = json.loads((ROOT / 'package-lock.json').read_text(encoding='utf-8'))
    return {folder: package for folder, package in lock['packages'].items()
            if 'node_modules/' in folder and not package.get('link')}


class Supply(unittest.TestCase):
    def setUp(self):
        self.rows = tables((ROOT / 'THIRD_PARTY.md').read_text(encoding='utf-8'))

    def test_npm_unpacks_what_was_locked_and_runs_nothing(self):
        self.assertTrue(locked())
        for folder, package in locked().items():
            self.assertTrue(package.get('resolved', REGISTRY).startswith(REGISTRY), folder)
            self.assertTrue(package['integrity'].startswith('sha512-'), folder)
            self.assertFalse(package.get('hasInstallScript'), folder)
        for script in ('scripts/build-web', 'scripts/test', '.ci/run'):
            for line in (ROOT / script).read_text(encoding='utf-8').splitlines():
                if 'npm ci' in line or 'npm install' in line:
                    self.assertIn('--ignore-scripts', line)

    def test_licences_of_npm(self):
        for folder, package in locked().items():
            is_tool = package.get('dev') or package.get('devOptional')
            licences = set(package['license'].strip('()').split(' AND '))
            self.assertLessEqual(licences, OF_TOOLS if is_tool else PERMISSIVE, folder)

    def test_versions_are_those_that_are_locked(self):
        named = {}
        for row in self.rows:
            for name in re.findall(r'`([^`]+)`', row.get('Found as', '')):
                named[name] = row
        checked = 0
        for folder, package in locked().items():
            row = named.get(folder.removeprefix('node_modules/'))
            if row is None or folder.startswith('node_modules/@types/'):
                continue
            version = row['Version'].split('.')
            self.assertEqual(package['version'].split('.')[:len(version)], version, folder)
            checked += 1
        self.assertGreater(checked, 10)

    @unittest.skipUnless(is_debian(12), 'the list has the versions of Debian 12')
    def test_versions_are_those_of_the_system(self):
        checked = 0
        for row in self.rows:
            for package in re.findall(r'`([^`]+)`', row.get('Packages', '')):
                installed = version_of_package(package)
                if row.get('Version') and installed:
                    self.assertRegex(installed, r'(^|git)' + re.escape(row['Version'].replace('-', '')) + r'(?!\d)', package)
                    checked += 1
        self.assertGreater(checked, 20)

    def test_versions_are_those_that_webassembly_is_built_of(self):
        text = (ROOT / 'scripts/wasm-dependencies').read_text(encoding='utf-8')
        archives = re.findall(r'^ +"\S+ (\S+) [0-9a-f]{64}"$', text, re.MULTILINE)
        self.assertGreater(len(archives), 5)
        versions = {row['Version'].replace('-', '') for row in self.rows if 'Library' in row}
        for archive in archives:
            self.assertTrue(any(version in archive for version in versions), archive)


class TheSearch(unittest.TestCase):
    def test_finds_what_is_asked_for(self):
        self.assertEqual(
            asked_by_cmake('find_package(Foo 3 REQUIRED)  # find_package(None)\nfind_package(Python3)\n'
                           'pkg_check_modules(X REQUIRED IMPORTED_TARGET libbar baz-4)\n'
                           'find_library(Y qux)\nfind_path(Z quux/a.h)'),
            {'Foo', 'libbar', 'baz-4', 'qux', 'quux'})
        self.assertEqual(asked_by_code('#include <vector>\n#include <foo/bar.h>\n  # include <baz.h>\n#include <sys/stat.h>'),
                         {'foo', 'baz.h'})


if __name__ == '__main__':
    unittest.main()
