"""The headers' comments as a reference: Doxygen has no complaints, and what they say is in it."""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]


def filtered(text):
    with tempfile.NamedTemporaryFile('w', suffix='.h') as file:
        file.write(text)
        file.flush()
        return subprocess.run([ROOT / 'scripts/doxygen-filter', file.name], check=True, capture_output=True).stdout.decode()


class Filter(unittest.TestCase):
    def test_comments_become_doxygens(self):
        self.assertEqual(
            filtered('// A file.\n#pragma once\n\n// All <b> @ once; `a<b>`, c<d>.\nstd::vector<int> f();  // of <g>\n'
                     'struct S {\n  // A line.\n  int i = 0;  // `<i>`\n};\n}  // namespace\n'),
            '/// @file\n/// A file.\n#pragma once\n\n/// All \\<b\\> \\@ once; `a<b>`, c\\<d\\>.\nstd::vector<int> f();  ///< of \\<g\\>\n'
            'struct S {\n  /// A line.\n  int i = 0;  ///< `<i>`\n};\n}  // namespace\n')


@unittest.skipUnless(shutil.which('doxygen'), 'there is no doxygen')
class Reference(unittest.TestCase):
    def test_is_made_without_warnings(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([ROOT / 'scripts/doxygen', folder], capture_output=True, timeout=600)
            self.assertEqual((done.returncode, done.stderr.decode()), (0, ''))
            page = pathlib.Path(folder, 'html/job_8h.html').read_text(encoding='utf-8')
            self.assertIn('the only entry into the techniques', page)
            self.assertIn('Runs the job on decoded pictures', page)


if __name__ == '__main__':
    unittest.main()
