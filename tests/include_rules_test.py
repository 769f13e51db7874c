"""Who may include whom, and what the core may not touch (ARCHITECTURE.md, "Who may include whom")."""
import pathlib
import re
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]

# Folder -> folders whose headers it may include beside its own. Any other folder in core/ is a technique.
CORE = {
    'base': set(),
    'image': {'base'},
    'geometry': {'base'},
    'formats': {'base', 'geometry'},
    'voronoi': {'base', 'image', 'geometry'},
    'gpu': {'base', 'voronoi'},
    'tessellation': {'base', 'geometry', 'voronoi'},
    'points': {'base', 'geometry'},
    'statistics': {'base', 'image', 'geometry', 'points'},
}
TECHNIQUE = {'base', 'image', 'geometry', 'voronoi', 'tessellation', 'points', 'statistics'}
NATIVE = {'io': {'base', 'image'}, 'egl': {'base'}, 'view': {'base', 'geometry', 'formats', 'gpu'}}
SOURCES = {'.h', '.cpp'}

FORBIDDEN_HEADERS = re.compile(
    r'fstream|iostream|filesystem|chrono|thread|ctime|time\.h|stdio\.h|cstdio|unistd\.h|sys/.*|'
    r'opencv2/(highgui|imgcodecs|videoio|opencv).*|emscripten.*|EGL/.*|SDL.*')
GL_HEADERS = re.compile(r'GLES.*|GL/.*')
FORBIDDEN_WORDS = re.compile(
    r'\b(imread|imwrite|imshow|imdecode|imencode|namedWindow|getenv|system_clock|steady_clock|std::\w+_distribution|s?rand'
    r'|random_device)\b')

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
LITERAL_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def rules(root):
    """Folder relative to the root -> what it may include."""
    core = sorted(path.name for path in (root / 'core').iterdir() if path.is_dir())
    techniques = {name for name in core if name not in CORE and name != 'job'}
    table = {f'core/{name}': CORE[name] for name in core if name in CORE}
    table.update({f'core/{name}': TECHNIQUE for name in techniques})
    table['core/job'] = TECHNIQUE | {'formats'} | techniques
    table.update({f'native/{name}': allowed for name, allowed in NATIVE.items()})
    return table


def code_of(text):
    """The text without comments and string literals, so that only code counts."""
    return LITERAL_OR_COMMENT.sub(lambda match: '""' if match[0].startswith('"') else ' ', text)


def complaints_about_core(folder, text):
    for _, header in INCLUDE.findall(text):
        if FORBIDDEN_HEADERS.fullmatch(header):
            yield f'includes <{header}>, which core may not'
        if GL_HEADERS.fullmatch(header) and (folder != 'core/gpu' or not header.startswith('GLES3/')):
            yield f'includes <{header}>; only core/gpu may, and only GLES3'
    for word in FORBIDDEN_WORDS.findall(code_of(text)):
        yield f'names {word}, which core may not'


def complaints_about_folders(folder, allowed, text):
    own = folder.split('/')[1]
    for _, header in INCLUDE.findall(text):
        if re.match(r'(\.\.|core|native|web)/', header):
            yield f'includes "{header}"; expected "tessera/FOLDER/FILE.h"'
        if header.startswith('tessera/') and header.split('/')[1] not in allowed | {own}:
            yield f'includes "{header}"; {own} may include {", ".join(sorted(allowed)) or "nobody"}'


def violations(root):
    found = []
    for folder, allowed in rules(root).items():
        for path in sorted((root / folder).rglob('*')):
            if path.suffix not in SOURCES:
                continue
            text = path.read_text(encoding='utf-8')
            complaints = list(complaints_about_folders(folder, allowed, text))
            if folder.startswith('core/'):
                complaints += complaints_about_core(folder, text)
            found += [f'{path.relative_to(root)} {complaint}' for complaint in complaints]
    return found


class TheTree(unittest.TestCase):
    def test_keeps_the_rules(self):
        self.assertEqual(violations(ROOT), [])

    def test_is_seen_at_all(self):
        for folder in rules(ROOT):
            self.assertTrue(list((ROOT / folder).glob('*.h')), folder)

    def test_rules_go_one_way(self):
        table = {folder.split('/')[1]: allowed for folder, allowed in rules(ROOT).items()}
        done = set()
        while len(done) < len(table):
            ready = {name for name, allowed in table.items() if name not in done and allowed <= done}
            self.assertTrue(ready, f'a circle among {sorted(set(table) - done)}')
            done |= ready


class TheRules(unittest.TestCase):
    """Small trees with one line that breaks a rule, or keeps it."""

    def check(self, path, line, broken):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name in [*CORE, 'job', 'pavement', 'mosaic']:
                (root / 'core' / name).mkdir(parents=True)
            file = root / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(f'#pragma once\n{line}\n', encoding='utf-8')
            found = violations(root)
        self.assertEqual(len(found), int(broken), f'{path}: {line}: {found}')

    def test_what_breaks_them(self):
        for path, line in [
                ('core/base/a.h', '#include "tessera/image/zones.h"'),
                ('core/image/a.h', '#include "tessera/voronoi/site.h"'),
                ('core/formats/a.cpp', '#include "tessera/image/zones.h"'),
                ('core/gpu/a.cpp', '#include "tessera/pavement/run.h"'),
                ('core/pavement/a.cpp', '#include "tessera/mosaic/run.h"'),
                ('core/pavement/a.cpp', '#include "tessera/job/job.h"'),
                ('core/job/a.cpp', '#include "tessera/io/picture.h"'),
                ('core/job/a.cpp', '#include "tessera/gpu/gl_rasterizer.h"'),
                ('core/job/a.cpp', '#include "../../native/io/picture.h"'),
                ('native/io/a.cpp', '#include "tessera/cli/settings.h"'),
                ('core/image/a.cpp', '# include <fstream>'),
                ('core/image/a.cpp', '#include <filesystem>'),
                ('core/pavement/a.cpp', '#include <thread>'),
                ('core/job/a.cpp', '#include <opencv2/imgcodecs.hpp>'),
                ('core/voronoi/a.cpp', '#include <GLES3/gl3.h>'),
                ('core/gpu/a.cpp', '#include <EGL/egl.h>'),
                ('core/gpu/a.cpp', '#include <emscripten/html5.h>'),
                ('core/image/a.cpp', 'cv::Mat a = cv::imread("a.png");'),
                ('core/base/a.h', 'std::normal_distribution<double> noise;')]:
            self.check(path, line, broken=True)

    def test_what_keeps_them(self):
        for path, line in [
                ('core/voronoi/a.cpp', '#include "tessera/base/status.h"'),
                ('core/voronoi/a.cpp', '#include "tessera/voronoi/site.h"'),
                ('core/gpu/a.cpp', '#include <GLES3/gl3.h>'),
                ('core/job/a.cpp', '#include "tessera/mosaic/run.h"'),
                ('core/mosaic/a.cpp', '// not cv::imread'),
                ('core/mosaic/a.cpp', 'const char* a = "imread // "; int b;')]:
            self.check(path, line, broken=False)


if __name__ == '__main__':
    unittest.main()
