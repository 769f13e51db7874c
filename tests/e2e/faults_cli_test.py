"""What goes wrong outside the program: disks that are full or read-only, folders that go meanwhile, signals at any moment,
too little memory, no graphics, too little time.
"""
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import time
import unittest

from cli import PROGRAM, CliTest, png

KILLS = 200
PATTERN = ['pattern', 'occupancy', '--width', '400', '--height', '400', '--intensity', '0.01']
PARQUET = ['parquet', 'target.png', '--panel', 'board.png,name=oak,dpi=60', '--image-size-mm', '50', '--patch-mm', '5',
           '--min-width-mm', '2', '--rotations', '6']
TEMPORARY = '.tessera-'


def arguments(*words):
    return [PROGRAM, *map(str, words)]


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class FaultsTest(CliTest):
    def setUp(self):
        super().setUp()
        self.put('board.png', png(240, 200, lambda x, y: (x * 13 + y * 7 + x * y // 5) % 251))
        self.put('target.png', png(50, 50, lambda x, y: (x * y) % 256))

    def start(self, *words, **options):
        return subprocess.Popen(arguments(*words), cwd=self.folder, stderr=subprocess.PIPE, **options)

    def contents(self, name=''):
        """Every file below a folder, by name; None where there is no folder."""
        folder = self.folder / name
        return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob('*')) if p.is_file()} \
            if folder.is_dir() else None

    def files_made(self, name):
        """Those of a parquetry that are the same each time: its report tells how long it took."""
        made = self.contents(name)
        made.pop('report.json')
        return made

    def wait_for(self, process, pattern):
        shown = b''
        while not re.search(pattern, shown):
            step = process.stderr.read1(64)
            self.assertTrue(step, f'it ended too early: {shown}')
            shown += step


class KillTest(FaultsTest):
    def seconds_of(self, *words):
        begin = time.monotonic()
        self.succeed(*words)
        return time.monotonic() - begin

    def kill(self, process, number, moment):
        try:
            said = process.communicate(timeout=moment)[1]
        except subprocess.TimeoutExpired:
            process.send_signal(number)
            said = process.communicate(timeout=300)[1]
        return process.returncode, said

    def test_an_older_output_is_whole_or_the_new_one_at_any_moment(self):
        names = ['a.svg', 'b.csv', 'c.json']
        words = [*PATTERN, *(word for name in names for word in ('-o', name))]
        usual = self.seconds_of(*words)
        new = {name: self.bytes_of(name) for name in names}
        old = {name: b'old ' + name.encode() for name in names}
        moments, ended, broken = random.Random(8), 0, 0
        for turn in range(KILLS):
            for name in names:
                self.put(name, old[name])
            before = self.names()
            number = (signal.SIGKILL, signal.SIGINT, signal.SIGTERM)[turn % 3]
            status, said = self.kill(self.start(*words), number, moments.uniform(0, 1.1 * usual))
            now = {name: self.bytes_of(name) for name in names}
            if number == signal.SIGKILL:  # which nothing can clean up after
                for name in names:
                    self.assertIn(now[name], (old[name], new[name]), name)
                self.assertIn(status, (0, -signal.SIGKILL), said)
                for name in set(self.names()) - set(before):
                    self.assertTrue(name.startswith(TEMPORARY), name)
                    (self.folder / name).unlink()
            else:
                self.assertIn(now, (old, new))
                self.assertEqual(self.names(), before)
                self.assertIn(status, (0, 130, -number), said)  # the last while the program is being loaded
                self.assertEqual(said, b'tessera: interrupted\n' if status == 130 else b'')
                self.assertEqual(now == new, status == 0)
            ended += now == new
            broken += now == old
        self.assertGreater(ended, KILLS // 50)
        self.assertGreater(broken, KILLS // 4)

    def test_a_folder_is_the_older_one_or_the_new_one(self):
        new_words, old_words = [*PARQUET, '-o', 'out'], [*PARQUET[:-1], '2', '-o', 'out']
        usual = self.seconds_of(*new_words)
        new = self.files_made('out')
        self.succeed(*old_words)
        old = self.files_made('out')
        self.assertNotEqual(old, new)
        moments = random.Random(9)
        for turn in range(20):
            status, said = self.kill(self.start(*new_words), (signal.SIGINT, signal.SIGTERM)[turn % 2],
                                     moments.uniform(0, 1.1 * usual))
            self.assertIn(status, (0, 130, -signal.SIGINT, -signal.SIGTERM), said)
            self.assertEqual(self.files_made('out'), new if status == 0 else old)
            self.assertEqual([name for name in self.names() if TEMPORARY in name], [])
            if status == 0:
                self.succeed(*old_words)
            (self.folder / 'out.checkpoint').unlink(missing_ok=True)

    def test_killed_again_and_again_it_is_resumed_to_the_same_bytes(self):
        usual = self.seconds_of(*PARQUET, '-o', 'whole')
        words = [*PARQUET, '-o', 'out', '--resume']
        moments, kept = random.Random(10), 0
        for turn in range(200):
            number = (signal.SIGTERM, signal.SIGKILL, signal.SIGINT)[turn % 3]
            before = (self.folder / 'out.checkpoint').exists()
            status, said = self.kill(self.start(*words), number, moments.uniform(0.3, 0.9) * usual)
            kept += (self.folder / 'out.checkpoint').exists()
            if status == 0:
                break
            self.assertIn(status, (130, -number), said)
            if status == 130 and not before and (self.folder / 'out.checkpoint').exists():
                self.assertIn(b'--resume goes on', said)
            self.assertFalse((self.folder / 'out').exists())
            if number == signal.SIGKILL and before:
                self.assertTrue((self.folder / 'out.checkpoint').exists())
        else:
            self.succeed(*words)
        self.assertGreater(kept, 0, 'it was never interrupted')
        self.assertEqual(self.files_made('out'), self.files_made('whole'))
        self.assertFalse((self.folder / 'out.checkpoint').exists())

    def test_a_checkpoint_that_somebody_has_changed_is_refused(self):
        run = self.start(*PARQUET, '-o', 'out', '--progress', 'always')
        self.wait_for(run, rb' [1-9]\d% matching')
        run.send_signal(signal.SIGINT)
        run.stderr.read()
        run.stderr.close()
        self.assertEqual(run.wait(timeout=300), 130)
        lines = self.bytes_of('out.checkpoint').decode().splitlines()
        numbers = lines[2].split()
        panel, rotation, x, turn = 9, 10, 11, 14
        for place, value in ((panel, '1'), (panel, '-2'), (panel, '1e9'), (rotation, '6'), (rotation, '-1'),
                             (x, '100000'), (x, '-1'), (x, 'nan'), (turn, '1'), (turn, '1e300'), (0, '7'), (5, '1e10')):
            wrong = [*numbers[:place], value, *numbers[place + 1:]]
            self.put('out.checkpoint', '\n'.join([*lines[:2], ' '.join(wrong), *lines[3:], '']).encode())
            with self.subTest(place=place, value=value):
                self.fail_with(3, *PARQUET, '-o', 'out', '--resume', says=['out.checkpoint: is of another job or damaged'])


class DiskTest(FaultsTest):
    def mount(self, size, *options):
        disk = self.folder / 'disk'
        disk.mkdir(exist_ok=True)
        mounted = subprocess.run(['mount', '-t', 'tmpfs', '-o', ','.join([f'size={size}', *options]), 'tmpfs', disk],
                                 capture_output=True)
        if mounted.returncode != 0:
            print('skipped: a small disk cannot be mounted here', file=sys.stderr)
            self.skipTest('mount is not allowed')
        self.addCleanup(subprocess.run, ['umount', disk], check=True)
        return disk

    def test_a_full_disk_keeps_the_older_files(self):
        disk = self.mount('32k')
        (disk / 'a.csv').write_bytes(b'older')
        (disk / 'b.svg').write_bytes(b'old')
        self.fail_with(4, *PATTERN, '-o', 'disk/a.csv', '-o', 'disk/b.svg', '-o', 'c.json',
                       says=['disk/', 'cannot be written: No space left on device'])
        self.assertEqual((disk / 'a.csv').read_bytes(), b'older')
        self.assertEqual((disk / 'b.svg').read_bytes(), b'old')
        for flag in ('--report', '--save-job', '--plots'):
            self.fail_with(4, *PATTERN, '-o', 'disk/a.csv', flag, 'disk/new', '-o', 'disk/b.svg',
                           says=['No space left on device'])
        self.succeed('pattern', 'checkerboard', '--size', '200', '-o', 'disk/b.svg')  # a small one has room
        self.assertIn(b'</svg>', (disk / 'b.svg').read_bytes())

    def test_a_full_disk_of_a_folder(self):
        disk = self.mount('64k')
        self.fail_with(4, *PARQUET, '-o', 'disk/out', says=['cannot be written: No space left on device'])
        self.assertEqual(list(disk.iterdir()), [])

    def test_a_checkpoint_that_has_no_room_stops_nobody(self):
        disk = self.mount('4k')
        (disk / 'full').write_bytes(bytes(4096))
        run = self.start(*PARQUET, '-o', 'disk/out', '--progress', 'always')
        self.wait_for(run, b'% matching')
        run.send_signal(signal.SIGINT)
        said = run.stderr.read()
        run.stderr.close()
        self.assertEqual(run.wait(timeout=300), 130)
        self.assertTrue(said.endswith(b'tessera: interrupted\n'), said)
        self.assertEqual([p.name for p in disk.iterdir()], ['full'])

    def test_results_of_a_batch_that_have_no_room_are_told(self):
        disk = self.mount('4k')
        (disk / 'full').write_bytes(bytes(4096))
        self.put('jobs.jsonl', b'{"schemaVersion": 1, "technique": "pattern", "params": {"width": 50, "height": 50}, '
                               b'"outputs": ["a.svg"]}\n')
        done = self.run_program('batch', 'jobs.jsonl', '--results', 'disk/results.jsonl')
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn(b'disk/results.jsonl: cannot be written: No space left on device', done.stderr)

    def test_a_read_only_disk(self):
        disk = self.mount('64k')
        (disk / 'old.svg').write_bytes(b'old')
        subprocess.run(['mount', '-o', 'remount,ro', disk], check=True)
        for name in ('new.svg', 'old.svg'):
            self.fail_with(4, *PATTERN, '-o', f'disk/{name}',
                           says=[f'disk/{name}: cannot be written: Read-only file system'])
        self.fail_with(4, *PARQUET, '-o', 'disk/out', says=['disk/out: cannot be made: Read-only file system'])
        self.assertEqual((disk / 'old.svg').read_bytes(), b'old')

    def test_a_folder_of_somebody_else(self):
        locked = self.folder / 'locked'
        locked.mkdir(mode=0o555)
        options = {}
        if os.geteuid() == 0:  # for whom no folder is locked
            self.folder.chmod(0o755)
            options = {'user': 65534, 'group': 65534, 'extra_groups': []}
        try:
            self.fail_with(4, *PATTERN, '-o', 'locked/a.svg',
                           says=['locked/a.svg: cannot be written: Permission denied'], **options)
        except (PermissionError, subprocess.SubprocessError) as error:
            print(f'skipped: nobody else can be asked here ({error})', file=sys.stderr)
            self.skipTest('no other user')

    def test_what_goes_meanwhile(self):
        self.put('large.png', self.large_disc)
        self.put('out/old.svg', b'old')
        run = self.start('pave', 'large.png', '-o', 'out/a.svg', '--iterations', 8, '--half-side', 3, '--progress', 'always')
        self.wait_for(run, b'% diagram')
        (self.folder / 'out' / 'old.svg').unlink()
        (self.folder / 'out').rmdir()
        (self.folder / 'large.png').unlink()  # which has been read
        said = run.stderr.read()
        run.stderr.close()
        self.assertEqual(run.wait(timeout=300), 4)
        self.assertTrue(said.endswith(b'tessera: out/a.svg: cannot be written: No such file or directory\n'), said)
        self.assertEqual([name for name in self.names() if TEMPORARY in name], [])

    def test_an_older_output_that_goes_meanwhile_is_made_anew(self):
        self.put('large.png', self.large_disc)
        self.put('a.svg', b'old')
        run = self.start('pave', 'large.png', '-o', 'a.svg', '--iterations', 8, '--half-side', 3, '--progress', 'always')
        self.wait_for(run, b'% diagram')
        (self.folder / 'a.svg').unlink()
        run.stderr.read()
        run.stderr.close()
        self.assertEqual(run.wait(timeout=300), 0)
        self.assertTrue(self.bytes_of('a.svg').endswith(b'</svg>\n'))


class MemoryTest(FaultsTest):
    def limited(self, megabytes, *words):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
        return self.run_program(*words, preexec_fn=limit)

    def test_too_little_memory_is_told(self):
        if self.limited(4096, '--version').returncode != 0:
            print('skipped: this build of the program cannot be held to so much memory', file=sys.stderr)
            self.skipTest('a sanitizer takes all addresses there are')
        least = next(mb for mb in range(8, 4096, 8) if self.limited(mb, '--version').returncode == 0)
        self.put('large.png', self.large_disc)
        for words in (['pave', 'large.png', '--iterations', 1], ['mosaic', 'large.png', '--iterations', 1, '--tiles', 300],
                      ['pattern', 'occupancy', '--width', 2000, '--height', 2000, '--intensity', 0.03], PARQUET):
            with self.subTest(words[0]):
                self.succeed(*words, '-o', 'whole.svg', '-o', 'whole.png', '--quiet')
                whole, before, refused = self.bytes_of('whole.png'), self.names(), 0
                for megabytes in (least, least + 32, 4096):
                    done = self.limited(megabytes, *words, '-o', 'a.svg', '-o', 'a.png', '--quiet')
                    refused += done.returncode != 0
                    if done.returncode == 0:
                        self.assertEqual(self.bytes_of('a.png'), whole)
                        (self.folder / 'a.svg').unlink()
                        (self.folder / 'a.png').unlink()
                    else:
                        self.assertEqual(done.returncode, 1, (megabytes, done.stderr))
                        self.assertRegex(done.stderr.decode(),
                                         r'\Atessera: (out of memory; |threads cannot be started )[^\n]*\n\Z', megabytes)
                    self.assertEqual(self.names(), before)
                self.assertGreater(refused, 0)
                self.assertEqual(done.returncode, 0, done.stderr)


class GraphicsTest(FaultsTest):
    def test_without_graphics_the_cpu_draws(self):
        nowhere = {**os.environ, 'LIBGL_DRIVERS_PATH': '/nowhere', '__EGL_VENDOR_LIBRARY_DIRS': '/nowhere',
                   '__EGL_VENDOR_LIBRARY_FILENAMES': '/nowhere.json'}
        self.succeed('pave', 'disc.png', '-o', 'cpu.svg', '--iterations', 2, '--backend', 'cpu')
        self.succeed('pave', 'disc.png', '-o', 'auto.svg', '--iterations', 2, '--backend', 'auto', env=nowhere)
        self.assertEqual(self.bytes_of('auto.svg'), self.bytes_of('cpu.svg'))
        self.fail_with(2, 'pave', 'disc.png', '-o', 'a.svg', '--iterations', 2, '--backend', 'gl', env=nowhere,
                       says=['backend: gl does not work here', 'expected auto or cpu'])


class TimeTest(FaultsTest):
    def test_the_time_limit_holds(self):
        """Of one thread, in time of the processor: as long as it may take where nothing else runs, and never longer."""
        self.put('huge.png', png(1500, 1500, lambda x, y: 255 * ((x // 7 * 31 + y // 5 * 17) % 3 % 2)))
        self.succeed('pattern', 'occupancy', '--width', 6000, '--height', 6000, '--intensity', 0.001, '--png-scale', 1,
                     '-o', 'cells.png')
        begin = cpu_seconds()
        self.succeed('--version')
        startup = cpu_seconds() - begin
        for words in (['pave', 'huge.png', '--half-side', 1], ['pave', 'huge.png', '--method', 'paper'],
                      ['mosaic', 'huge.png', '--tiles', 200000], ['pebbles', 'cells.png', '--width', 6000],
                      ['pattern', 'poisson-lines', '--width', 9000, '--height', 9000, '--intensity', 0.1],
                      ['pattern', 'occupancy', '--width', 9000, '--height', 9000, '--intensity', 0.03],
                      ['parquet', 'huge.png', '--panel', 'huge.png,name=oak,dpi=200', '--image-size-mm', 300]):
            for limit in (0.3, 1):
                with self.subTest(' '.join(map(str, words)), limit=limit):
                    (self.folder / 'a.svg').unlink(missing_ok=True)
                    begin = cpu_seconds()
                    done = self.run_program(*words, '-o', 'a.svg', '--timeout', limit, '--threads', 1, '--quiet')
                    self.assertEqual((done.returncode, done.stderr), (124, b'tessera: out of time (--timeout)\n'))
                    self.assertLess(cpu_seconds() - begin, 1.1 * limit + 2 * startup + 0.02)
                    self.assertEqual([name for name in self.names() if name == 'a.svg' or TEMPORARY in name], [])


class LimitsTest(FaultsTest):
    def test_what_would_take_all_memory_is_refused_before_it_does(self):
        for words, says in ((['pave', 'disc.png', '--max-pixels', 14399], '(--max-pixels)'),
                            (['pattern', 'gaussian', '--width', 65536, '--height', 65536], '(--size)'),
                            (['pattern', 'occupancy', '--intensity', 1e6], '(--intensity)'),
                            (['pattern', 'checkerboard', '--size', 6e4, '--width', 65536, '--height', 65536, '--png-scale', 1],
                             '(--png-scale)'),
                            ([*PARQUET[:4], '--image-size-mm', 10000], '(--image-size-mm)')):
            with self.subTest(words):
                status = 3 if says == '(--max-pixels)' else 2
                done = self.fail_with(status, *words, '-o', 'a.png', '--quiet', says=['expected', says])
                self.assertLess(len(done.stderr), 300)


if __name__ == '__main__':
    # A user who is not root may mount small disks in a namespace of their own.
    wrapped = ['unshare', '--user', '--map-root-user', '--mount']
    if os.geteuid() != 0 and 'TESSERA_IN_NAMESPACE' not in os.environ \
            and subprocess.run([*wrapped, 'true'], capture_output=True).returncode == 0:
        os.execvpe('unshare', [*wrapped, sys.executable, '-B', str(pathlib.Path(__file__).resolve()), *sys.argv[1:]],
                   {**os.environ, 'TESSERA_IN_NAMESPACE': '1'})
    unittest.main()
