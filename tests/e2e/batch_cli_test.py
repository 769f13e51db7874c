"""`tessera batch`: many jobs, each on its own, as a person who starts, breaks and resumes it sees them."""
import json
import pathlib
import random
import signal
import subprocess
import time
import unittest

from cli import PROGRAM, CliTest


def job(seed, *outputs, **changes):
    return {'schemaVersion': 1, 'technique': 'pattern', 'seed': seed, 'inputs': {},
            'params': {'model': 'occupancy', 'width': 300, 'height': 300, **changes}, 'outputs': list(outputs)}


class BatchTest(CliTest):
    def jobs(self, lines, name='jobs.jsonl'):
        self.put(name, ''.join((line if isinstance(line, str) else json.dumps(line)) + '\n' for line in lines).encode())
        return name

    def results(self, name='jobs.results.jsonl'):
        return [json.loads(line) for line in self.bytes_of(name).decode().splitlines()]

    def batch(self, *arguments):
        return self.run_program('batch', *arguments)

    def test_each_line_is_what_run_makes_of_it(self):
        with_picture = {'schemaVersion': 1, 'technique': 'pavement', 'inputs': {'drawing': 'disc.png'},
                        'outputs': ['stones.svg', 'stones.json'], 'report': 'stones.report.json'}
        lines = [job(1, 'a.svg'), '', with_picture, job(2, 'b.svg', model='delaunay')]
        done = self.batch(self.jobs(lines), '--jobs', 2)
        self.assertEqual((done.returncode, done.stderr), (0, b'tessera: jobs: 3 done, 0 failed\n'))
        results = sorted(self.results(), key=lambda entry: entry['line'])
        self.assertEqual([(r['line'], r['status'], r['outputs']) for r in results],
                         [(1, 0, ['a.svg']), (3, 0, ['stones.svg', 'stones.json']), (4, 0, ['b.svg'])])
        self.assertEqual(json.loads(self.bytes_of('stones.report.json'))['technique'], 'pavement')
        for seed, name, model in [(1, 'a', 'occupancy'), (2, 'b', 'delaunay')]:
            self.run_program('pattern', model, '--seed', seed, '--width', 300, '--height', 300, '-o', 'own.svg')
            self.assertEqual(self.bytes_of(name + '.svg'), self.bytes_of('own.svg'))

    def test_a_broken_job_stops_no_other(self):
        self.put('cheese.png', b'cheese')
        cheese = {'schemaVersion': 1, 'technique': 'mosaic', 'inputs': {'photo': 'cheese.png'}, 'outputs': ['c.svg']}
        broken = [('{', 3, 'JSON'), ('[' * 100, 3, 'nests'), ('7', 3, 'expected a job'), (cheese, 3, 'cheese.png'),
                  (job(1), 3, 'outputs'), (job(1, '-'), 3, 'outputs'), (job(1, 'x.svg', model='brie'), 2, 'brie'),
                  (job(1, 'x.cheese'), 2, 'x.cheese'), (job(1, 'no/where/x.svg'), 4, 'no/where/x.svg'),
                  ('x' * (3 << 20), 3, 'bytes long'), ({**job(1, 'x.svg'), 'report': 7}, 3, 'report')]
        lines = [line for text, *_ in broken for line in (text, job(len(str(text)), f'{len(str(text))}.svg'))]
        done = self.batch(self.jobs(lines))
        self.assertEqual(done.returncode, 3, 'that of the first line')
        results = self.results()
        self.assertEqual([r['line'] for r in results], list(range(1, len(lines) + 1)))
        for (text, status, word), entry in zip(broken, results[::2]):
            self.assertEqual(entry['status'], status, entry)
            self.assertIn(word, ' '.join(entry['messages']))
        self.assertEqual({r['status'] for r in results[1::2]}, {0})

    def test_a_job_that_is_killed_or_late_is_told(self):
        lines = [job(1, 'late.svg', width=5000, height=5000, intensity=0.05), job(2, 'b.svg')]
        self.assertEqual(self.batch(self.jobs(lines), '--timeout', 0.2).returncode, 124)
        self.assertEqual([r['status'] for r in self.results()], [124, 0])
        batch = subprocess.Popen([PROGRAM, 'batch', 'jobs.jsonl'], cwd=self.folder, stderr=subprocess.PIPE)
        child = self.child_of(batch)
        subprocess.run(['kill', '-KILL', child], check=True)
        batch.communicate(timeout=300)
        self.assertEqual([r['status'] for r in self.results()], [128 + signal.SIGKILL, 0])
        self.assertEqual(batch.returncode, 128 + signal.SIGKILL)

    @staticmethod
    def child_of(process):
        for _ in range(3000):
            children = pathlib.Path(f'/proc/{process.pid}/task/{process.pid}/children').read_text().split()
            if children:
                return children[0]
            time.sleep(0.01)
        raise AssertionError('it has no child')

    def test_shards_are_all_jobs_once(self):
        name = self.jobs([job(i, f'{i}.svg') for i in range(1, 11)])
        lines = []
        for shard in range(1, 4):
            self.assertEqual(self.batch(name, '--shard', f'{shard}/3').returncode, 0)
            lines += [r['line'] for r in self.results(f'jobs.{shard}-of-3.results.jsonl')]
        self.assertEqual(sorted(lines), list(range(1, 11)))
        for wrong in ('0/3', '4/3', '1', '1/', '/3', '1/3x', 'a/b'):
            refused = self.batch(name, '--shard', wrong)
            self.assertEqual(refused.returncode, 2)
            self.assertIn(b'expected i/n', refused.stderr)

    def test_killed_at_any_moment_it_is_resumed_with_nothing_lost_or_done_twice(self):
        count = 40
        name = self.jobs([job(i, f'{i}.svg') for i in range(1, count + 1)])
        moments = random.Random(1)
        for kill in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT) * 3:
            batch = subprocess.Popen([PROGRAM, 'batch', name, '--resume', '--jobs', '2'], cwd=self.folder,
                                     stderr=subprocess.PIPE)
            time.sleep(moments.uniform(0.02, 0.15))
            batch.send_signal(kill)
            said = batch.communicate(timeout=300)[1]
            if kill != signal.SIGKILL and batch.returncode != 0:
                self.assertEqual(batch.returncode, 130, said)
                self.assertIn(b'--resume goes on', said)
        self.assertEqual(self.batch(name, '--resume').returncode, 0)
        self.assertEqual(sorted(r['line'] for r in self.results() if r['status'] == 0), list(range(1, count + 1)))
        self.assertEqual(len([n for n in self.names() if n.endswith('.svg')]), count)
        again = self.batch(name, '--resume')
        self.assertIn(f'{count} done before'.encode(), again.stderr)
        (self.folder / '7.svg').unlink()
        changed = [job(i, f'{i}.svg') for i in range(1, count + 1)]
        changed[8] = job(99, '9.svg')
        self.batch(self.jobs(changed), '--resume')
        self.assertEqual([r['line'] for r in self.results()[count:]], [7, 9])

    def test_a_line_of_results_that_was_cut_off_goes(self):
        name = self.jobs([job(1, 'a.svg'), job(2, 'b.svg')])
        self.batch(name)
        whole = self.bytes_of('jobs.results.jsonl')
        self.put('jobs.results.jsonl', whole[:-10])
        self.assertEqual(self.batch(name, '--resume').returncode, 0)
        self.assertEqual([r['line'] for r in self.results()], [1, 2])

    def test_what_cannot_be_read_or_written(self):
        self.assertEqual(self.batch('none.jsonl').returncode, 3)
        self.assertEqual(self.batch('.').returncode, 3)
        name = self.jobs([job(1, 'a.svg')])
        self.assertEqual(self.batch(name, '--results', 'no/where.jsonl').returncode, 4)
        self.assertEqual(self.batch(self.jobs([]), '--quiet').stderr, b'')


if __name__ == '__main__':
    unittest.main()
