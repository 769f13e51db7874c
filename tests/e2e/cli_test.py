"""Drives the program as its users do: pictures in, files, messages and exit statuses out. What is the same for every
technique is asked of pavement.
"""
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import unittest

from cli import PROGRAM, ROOT, CliTest, disc, png

HOSTILE_PICTURES = ROOT.parent / 'shared' / 'data' / 'bad'
QUICK = ['--iterations', '2']
LONG = ['--iterations', '1000', '--half-side', '2']


class UsageTest(CliTest):
    def test_version_and_help(self):
        version = (ROOT / 'VERSION').read_text().strip()
        self.assertEqual(self.succeed('--version').stdout.decode(), f'tessera {version}\n')
        text = self.succeed('pave', '--help').stdout.decode()
        for name, about in json.loads(self.succeed('schema', 'pavement').stdout)['properties'].items():
            flag = '--' + ''.join('-' + c.lower() if c.isupper() else c for c in name)
            line = next(line for line in text.splitlines() if line.split()[:1] == [flag])
            self.assertIn(f'default {about["default"]}', line)
            if 'minimum' in about:
                self.assertIn(f'{about["minimum"]} to {about["maximum"]} {about.get("x-unit", "")}'.strip(), line)

    def test_only_commands_that_work_are_listed(self):
        text = self.succeed('--help').stdout.decode()
        commands = [line.split()[0] for line in text.split('Subcommands:')[1].splitlines() if line.strip()]
        self.assertEqual(commands, ['pave', 'mosaic', 'pebbles', 'pattern', 'parquet', 'measure', 'fit', 'run', 'batch', 'view', 'schema', 'completion'])
        for command in commands:
            self.succeed(command, '--help')

    def test_wrong_usage(self):
        self.fail_with(2, says=['expected pave, mosaic, pebbles, pattern, parquet, measure, fit, run, batch, view, schema or completion'])
        self.fail_with(2, 'fold', says=['fold'])
        self.fail_with(2, 'pave', says=['DRAWING'])
        self.fail_with(2, 'pave', 'disc.png', says=['-o'])
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--nonsense', says=['--nonsense'])
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--half-side', says=['--half-side'])
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a.bmp', says=['a.bmp', 'expected svg, dxf, png, json, csv, glb, gltf or apng'])
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a', says=['a: has no extension'])
        self.fail_with(2, 'pave', 'disc.png', '-o', '-', says=['--format'])
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '-o', 'a.svg', says=['two outputs'])
        self.fail_with(2, 'schema', 'cheese', says=['cheese', 'expected pavement, mosaic, pebbles, pattern or parquetry'])

    def test_parameters_out_of_range(self):
        done = self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--half-side', '0.2')
        self.assertEqual(done.stderr.decode(), 'tessera: halfSide: is 0.2, expected 1 to 512 px (--half-side)\n')
        for value in ('nan', 'inf', '-inf', '1e999', 'four', '', '4px'):
            self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--half-side', value, says=['halfSide: is '])
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--colors', '2.5', says=['a whole number, 2 to 16'])
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--method', 'fast', says=['expected flow or paper'])
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--stretch-min', '3', says=['--stretch-min'])
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--threads', '0', says=['1 to 1024'])
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--backend', 'tpu', says=['auto, cpu or gl'])

    def test_all_problems_at_once(self):
        done = self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--half-side', '0', '--colors', '1',
                              '--seed', '-1', '--timeout', '0', lines=4)
        for flag in ('--half-side', '--colors', '--seed', '--timeout'):
            self.assertIn(f'({flag})', done.stderr.decode())

    def test_schema_is_json_schema(self):
        schema = json.loads(self.succeed('schema').stdout)
        self.assertEqual(schema['$schema'], 'https://json-schema.org/draft/2020-12/schema')
        self.assertEqual(schema['$defs']['pavement']['properties']['halfSide']['x-unit'], 'px')

    def test_parameter_reference_is_up_to_date(self):
        printed = self.succeed('schema', '--markdown').stdout.decode()
        kept = (ROOT / 'docs' / 'parameters.md').read_text()
        self.assertEqual(kept, printed, 'tessera schema --markdown > docs/parameters.md')


class InputTest(CliTest):
    def refuse(self, data, *says):
        self.put('bad.png', data)
        self.fail_with(3, 'pave', 'bad.png', '-o', 'a.svg', says=['bad.png: ', *says])

    def test_what_is_no_picture(self):
        self.refuse(b'', 'is empty')
        self.refuse(b'not a picture at all\n' * 9, 'expected PNG, JPEG, WebP, TIFF or BMP')
        self.refuse(b'<svg xmlns="http://www.w3.org/2000/svg"/>', 'expected PNG, JPEG, WebP, TIFF or BMP')
        self.refuse(b'GIF89a' + bytes(100), 'expected PNG, JPEG, WebP, TIFF or BMP')
        self.fail_with(3, 'pave', 'missing.png', '-o', 'a.svg', says=['missing.png: cannot be opened'])
        self.fail_with(3, 'pave', '.', '-o', 'a.svg', says=['cannot be read'])

    def test_cut_short_and_damaged(self):
        for size in (9, 30, 60, len(self.disc) // 2, len(self.disc) - 13, len(self.disc) - 1):
            self.refuse(self.disc[:size])
        damaged = bytearray(self.disc)
        damaged[len(damaged) // 2] ^= 255
        self.refuse(bytes(damaged), 'damaged PNG')

    def test_sizes_in_the_header(self):
        self.refuse(png(1, 1, lambda x, y: 0, claimed=(100000, 100000)), '100000 x 100000', '--max-pixels')
        self.refuse(png(1, 1, lambda x, y: 0, claimed=(0, 0)), '0 x 0')
        self.fail_with(3, 'pave', 'disc.png', '-o', 'a.svg', '--max-pixels', '14399', says=['--max-pixels'])
        self.succeed('pave', 'disc.png', '-o', 'a.svg', '--max-pixels', '14400', *QUICK)

    def test_small_and_plain_pictures(self):
        for name, data in {'one': png(1, 1, lambda x, y: 0), 'black': png(80, 60, lambda x, y: 0),
                           'white': png(80, 60, lambda x, y: 255), 'strip': png(500, 1, lambda x, y: 255 * (x % 2)),
                           'noise': png(64, 64, lambda x, y: 255 * ((x * 7919 + y * 104729) % 13 % 2))}.items():
            with self.subTest(name):
                self.put('plain.png', data)
                done = self.run_program('pave', 'plain.png', '-o', 'plain.svg', *QUICK)
                self.assertIn(done.returncode, (0, 3), done.stderr)
                if done.returncode == 0:
                    self.assertIn(b'</svg>', self.bytes_of('plain.svg'))
                else:
                    self.assertEqual(done.stderr.count(b'\n'), 1)

    def test_hostile_pictures(self):
        if not HOSTILE_PICTURES.is_dir():
            print(f'skipped: there are no pictures in {HOSTILE_PICTURES}', file=sys.stderr)
            self.skipTest('no hostile pictures beside the checkout')
        for path in sorted(HOSTILE_PICTURES.iterdir()):
            with self.subTest(path.name):
                done = self.run_program('pave', path, '-o', 'a.svg', '--half-side', '8', *QUICK)
                self.assertIn(done.returncode, (0, 3), done.stderr)
                self.assertEqual(done.stderr.count(b'\n'), 1 if done.returncode else 0, done.stderr)

    def test_standard_input(self):
        self.succeed('pave', 'disc.png', '-o', 'file.csv', *QUICK)
        self.succeed('pave', '-', '-o', 'pipe.csv', *QUICK, input=self.disc)
        self.assertEqual(self.bytes_of('file.csv'), self.bytes_of('pipe.csv'))
        self.fail_with(3, 'pave', '-', '-o', 'a.csv', input=b'', says=['standard input: is empty'])


class OutputTest(CliTest):
    def test_several_outputs(self):
        self.succeed('pave', 'disc.png', '-o', 'a.svg', '-o', 'b.DXF', '-o', 'c.png', '-o', 'd.json', '-o', 'e.csv',
                     '--plots', 'plots', *QUICK)
        self.assertEqual(self.names(), ['a.svg', 'b.DXF', 'c.png', 'd.json', 'disc.png', 'e.csv', 'plots/areas.svg',
                                        'plots/vertices.svg'])
        pieces = self.bytes_of('a.svg').count(b'<path id="stone-')
        self.assertGreater(pieces, 50)
        self.assertEqual(len(json.loads(self.bytes_of('d.json'))['features']), pieces)
        self.assertEqual(self.bytes_of('e.csv').count(b'\n'), pieces + 1)
        self.assertTrue(self.bytes_of('c.png').startswith(b'\x89PNG'))

    def test_standard_output(self):
        self.succeed('pave', 'disc.png', '-o', 'a.svg', *QUICK)
        done = self.succeed('pave', 'disc.png', '-o', '-', '--format', 'svg', *QUICK)
        self.assertEqual(done.stdout, self.bytes_of('a.svg'))
        self.assertEqual(done.stderr, b'')

    def test_closed_pipe(self):
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([PROGRAM, 'pave', 'disc.png', '-o', '-', '--format', 'svg', *QUICK], cwd=self.folder,
                              stdout=writer, stderr=subprocess.PIPE)
        os.close(writer)
        self.assertEqual(done.returncode, 4)
        self.assertIn(b'standard output: cannot be written', done.stderr)

    def test_folders_that_cannot_hold_it(self):
        self.put('file', b'')
        for target in ('missing/a.svg', 'file/a.svg', '/proc/a.svg'):
            self.fail_with(4, 'pave', 'disc.png', '-o', target, *QUICK, says=[f'{target}: cannot be written: '])
        self.fail_with(4, 'pave', 'disc.png', '-o', 'a.svg', '--report', 'missing/r.json', *QUICK)
        self.fail_with(4, 'pave', 'disc.png', '-o', 'a.svg', '--save-job', 'missing/j.json', *QUICK)
        self.fail_with(4, 'pave', 'disc.png', '-o', 'a.svg', '--plots', 'missing/plots', *QUICK)

    def test_a_read_only_folder(self):
        if os.geteuid() == 0:
            self.skipTest('no folder is read-only for root')
        locked = self.folder / 'locked'
        locked.mkdir()
        locked.chmod(0o555)
        self.fail_with(4, 'pave', 'disc.png', '-o', 'locked/a.svg', *QUICK, says=['Permission denied'])

    def test_a_full_device(self):
        if not os.path.exists('/dev/full'):
            self.skipTest('this system has no /dev/full')
        self.fail_with(4, 'pave', 'disc.png', '-o', 'a.svg', '-o', '/dev/full', '--format', 'svg', *QUICK,
                       says=['/dev/full: cannot be written: No space left on device'])
        self.assertTrue(pathlib.Path('/dev/full').is_char_device())

    def test_a_full_disk(self):
        disk = self.folder / 'disk'
        disk.mkdir()
        mounted = subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=16k', 'tmpfs', disk], capture_output=True)
        if mounted.returncode != 0:
            print('skipped: a small disk cannot be mounted here', file=sys.stderr)
            self.skipTest('mount is not allowed')
        self.addCleanup(subprocess.run, ['umount', disk], check=True)
        (disk / 'old.svg').write_bytes(b'old')
        for name in ('new.svg', 'old.svg'):
            self.fail_with(4, 'pave', 'disc.png', '-o', 'first.csv', '-o', f'disk/{name}', *QUICK,
                           says=[f'disk/{name}: cannot be written: No space left on device'])
        self.assertEqual((disk / 'old.svg').read_bytes(), b'old')

    def test_an_older_result_is_replaced(self):
        self.put('a.svg', b'old')
        self.succeed('pave', 'disc.png', '-o', 'a.svg', *QUICK)
        self.assertIn(b'</svg>', self.bytes_of('a.svg'))


class StopTest(CliTest):
    def stop_in_the_middle(self, number):
        self.put('large.png', self.large_disc)
        before = self.names()
        process = subprocess.Popen([PROGRAM, 'pave', 'large.png', '-o', 'a.svg', '--save-job', 'j.json', '--progress',
                                    'always', *LONG], cwd=self.folder, stderr=subprocess.PIPE)
        shown = b''
        while shown.count(b'% diagram') < 2:  # well within the longest stage
            step = process.stderr.read1(64)
            self.assertTrue(step, 'it ended before it was stopped')
            shown += step
        process.send_signal(number)
        rest = process.stderr.read()
        process.stderr.close()
        self.assertEqual(process.wait(timeout=60), 130)
        self.assertTrue(rest.endswith(b'tessera: interrupted\n'), rest)
        self.assertEqual(self.names(), before)

    def test_interrupt(self):
        self.stop_in_the_middle(signal.SIGINT)

    def test_termination(self):
        self.stop_in_the_middle(signal.SIGTERM)

    def test_out_of_time(self):
        self.put('large.png', self.large_disc)
        self.fail_with(124, 'pave', 'large.png', '-o', 'a.svg', '--timeout', '0.3', *LONG, says=['--timeout'])

    def test_out_of_time_while_waiting_for_input(self):
        reader, writer = os.pipe()
        self.fail_with(124, 'pave', '-', '-o', 'a.svg', '--timeout', '0.2', stdin=reader)
        os.close(reader)
        os.close(writer)


class ProgressTest(CliTest):
    def test_bar(self):
        self.assertEqual(self.succeed('pave', 'disc.png', '-o', 'a.svg', *QUICK).stderr, b'')
        bar = self.succeed('pave', 'disc.png', '-o', 'a.svg', '--progress', 'always', *QUICK).stderr
        self.assertIn(b'%', bar)
        self.assertNotIn(b'\n', bar)
        quiet = self.succeed('pave', 'disc.png', '-o', 'a.svg', '--progress', 'always', '--quiet', *QUICK).stderr
        self.assertEqual(quiet, b'')


class JobTest(CliTest):
    def test_a_saved_job_makes_the_same_bytes(self):
        self.succeed('pave', 'disc.png', '-o', 'a.svg', '--save-job', 'job.json', '--seed', '7', '--grout', '1',
                     *QUICK)
        job = json.loads(self.bytes_of('job.json'))
        self.assertEqual(list(job), ['schemaVersion', 'technique', 'seed', 'params', 'inputs'])
        self.assertEqual((job['seed'], job['params']['grout'], job['inputs']), (7, 1, {'drawing': 'disc.png'}))
        self.succeed('run', 'job.json', '-o', 'b.svg', '--save-job', 'again.json')
        self.assertEqual(self.bytes_of('a.svg'), self.bytes_of('b.svg'))
        self.assertEqual(self.bytes_of('job.json'), self.bytes_of('again.json'))

    def test_an_svg_is_a_job(self):
        self.succeed('pave', 'disc.png', '-o', 'a.svg', '--half-side', '5.5', *QUICK)
        self.succeed('run', 'a.svg', '-o', 'b.svg')
        self.assertEqual(self.bytes_of('a.svg'), self.bytes_of('b.svg'))
        self.succeed('run', '-', '-o', 'c.svg', input=self.bytes_of('a.svg'))
        self.assertEqual(self.bytes_of('a.svg'), self.bytes_of('c.svg'))

    def test_inputs_are_found_beside_the_job_then_here(self):
        self.put('deep/disc.png', disc(60))
        self.succeed('pave', 'disc.png', '-o', 'large.csv', '--save-job', 'deep/job.json', *QUICK)
        self.succeed('run', 'deep/job.json', '-o', 'small.csv')
        self.assertLess(len(self.bytes_of('small.csv')), len(self.bytes_of('large.csv')))
        (self.folder / 'deep' / 'disc.png').unlink()
        self.succeed('run', 'deep/job.json', '-o', 'again.csv')
        self.assertEqual(self.bytes_of('again.csv'), self.bytes_of('large.csv'))

    def test_set(self):
        self.succeed('pave', 'disc.png', '-o', 'a.csv', '--half-side', '6', '--seed', '3', *QUICK)
        self.succeed('pave', 'disc.png', '-o', 'b.csv', '--save-job', 'job.json', *QUICK)
        self.succeed('run', 'job.json', '--set', 'halfSide=6', '--set', 'seed=3', '-o', 'c.csv')
        self.assertEqual(self.bytes_of('a.csv'), self.bytes_of('c.csv'))
        self.assertNotEqual(self.bytes_of('b.csv'), self.bytes_of('c.csv'))
        self.put('other.png', disc(60))
        self.succeed('run', 'job.json', '--set', 'drawing=other.png', '-o', 'd.csv')
        self.assertNotEqual(self.bytes_of('b.csv'), self.bytes_of('d.csv'))
        self.fail_with(2, 'run', 'job.json', '--set', 'halfSide=0.2', '--set', 'nonsense=1', '--set', 'alone', '-o',
                       'e.csv', lines=3,
                       says=['halfSide: is 0.2, expected 1 to 512 px (--set)', 'nonsense', 'key=value'])

    def test_jobs_that_cannot_be(self):
        def refuse(status, text, *says, lines=1):
            self.put('job.json', text.encode())
            self.fail_with(status, 'run', 'job.json', '-o', 'a.svg', lines=lines, says=['job.json: ', *says])

        refuse(3, '')
        refuse(3, '{"schemaVersion": 1', 'line 1')
        refuse(3, '[' * 100000)
        refuse(3, '<svg/>', 'no job')
        refuse(3, '<svg><metadata>{&lol;}</metadata></svg>', 'entity')
        refuse(2, '{"schemaVersion": 1, "technique": "cheese"}', 'expected pavement')
        refuse(2, '{"schemaVersion": 1, "technique": "pavement", "params": {"halfsize": 4}}', 'halfsize')
        refuse(2, '{"schemaVersion": 9, "technique": "pavement", "extra": 1,'
                  ' "params": {"halfSide": 0, "colors": 1.5}}',
               'extra', 'schemaVersion', 'halfSide', 'colors', lines=4)
        self.put('job.json', b'{"schemaVersion": 1, "technique": "pavement"}')
        self.fail_with(3, 'run', 'job.json', '-o', 'a.svg', says=['drawing: is missing'])
        self.fail_with(3, 'run', 'missing.json', '-o', 'a.svg', says=['missing.json: cannot be opened'])

    def test_any_number_of_threads_makes_the_same_bytes(self):
        for threads in (1, 2, 4):
            self.succeed('pave', 'disc.png', '-o', f'{threads}.svg', '--threads', threads, *QUICK)
        self.assertEqual(self.bytes_of('1.svg'), self.bytes_of('2.svg'))
        self.assertEqual(self.bytes_of('1.svg'), self.bytes_of('4.svg'))

    def test_backends(self):
        self.succeed('pave', 'disc.png', '-o', 'a.csv', '--backend', 'cpu', *QUICK)
        done = self.run_program('pave', 'disc.png', '-o', 'b.csv', '--backend', 'gl', '--report', 'r.json', *QUICK)
        if done.returncode == 0:
            self.assertEqual(json.loads(self.bytes_of('r.json'))['backend'], 'gl')
        else:
            self.assertEqual((done.returncode, done.stderr.count(b'\n')), (2, 1), done.stderr)
            self.assertIn(b'expected auto or cpu', done.stderr)


class ReportTest(CliTest):
    def test_report(self):
        self.succeed('pave', 'disc.png', '-o', 'a.svg', '-o', 'b.csv', '--save-job', 'job.json', '--plots', 'plots',
                     '--report', 'report.json', '--backend', 'cpu', '--threads', '2', '--seed', '9', *QUICK)
        report = json.loads(self.bytes_of('report.json'))
        self.assertEqual(list(report), ['tessera', 'technique', 'seed', 'backend', 'threads', 'inputs', 'params',
                                        'stages', 'total_ms', 'peak_rss_mb', 'counts', 'metrics', 'outputs'])
        self.assertEqual(report['tessera'], (ROOT / 'VERSION').read_text().strip())
        self.assertEqual((report['technique'], report['seed'], report['backend'], report['threads']),
                         ('pavement', 9, 'cpu', 2))
        self.assertEqual(report['inputs'], [{'path': 'disc.png', 'width': 120, 'height': 120,
                                             'sha256': hashlib.sha256(self.disc).hexdigest()}])
        self.assertEqual(report['params'], json.loads(self.bytes_of('job.json'))['params'])
        names = [stage['name'] for stage in report['stages']]
        self.assertEqual((names[0], names[-1]), ('decode', 'write'))
        self.assertEqual(len(names), len(set(names)))
        for stage in report['stages']:
            self.assertGreaterEqual(min(stage['ms'], stage['cpu_ms']), 0)
        self.assertLessEqual(sum(stage['ms'] for stage in report['stages']), report['total_ms'] + 0.01)
        self.assertGreater(report['peak_rss_mb'], 1)
        stones = self.bytes_of('a.svg').count(b'<path id="stone-')
        self.assertEqual(report['counts']['stones'], stones)
        self.assertEqual(sum(n for name, n in report['counts'].items() if name.startswith('stones_with_')), stones)
        self.assertLessEqual(report['metrics']['quad_fraction'], 1)
        self.assertEqual([file['path'] for file in report['outputs']],
                         ['a.svg', 'b.csv', 'plots/vertices.svg', 'plots/areas.svg', 'job.json'])
        for file in report['outputs']:
            data = self.bytes_of(file['path'])
            self.assertEqual((file['bytes'], file['sha256']), (len(data), hashlib.sha256(data).hexdigest()))


if __name__ == '__main__':
    unittest.main()
