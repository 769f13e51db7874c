"""Many jobs on a cluster of this machine: a node that dies in the middle, and nothing lost or done twice.

Slurm's daemons are started in a folder of their own and stopped again; they want root. Nothing is installed: what is not
there is skipped, and says so. Not part of the common suite, as it takes a minute and two.

    TESSERA=build/native-release/bin/tessera python3 tests/cluster/cluster_test.py -v
"""
import collections
import contextlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.path.abspath(os.environ.get('TESSERA', ROOT / 'build/native-release/bin/tessera'))
JOBS = 200
SLURM = ['munged', 'slurmctld', 'slurmd', 'sbatch', 'squeue', 'scontrol']

SLURM_CONF = """
ClusterName=here
SlurmctldHost={host}
SlurmctldPort=26817
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CryptoType=crypto/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=1,sched_interval=1
MpiDefault=none
ReturnToService=0
SlurmdTimeout=10
KillWait=2
SlurmdParameters=config_overrides
NodeName=one NodeHostname={host} NodeAddr=127.0.0.1 Port=26818 CPUs=4 State=UNKNOWN
NodeName=two NodeHostname={host} NodeAddr=127.0.0.1 Port=26819 CPUs=4 State=UNKNOWN
PartitionName=all Nodes=one,two Default=YES MaxTime=INFINITE State=UP
"""


def missing(programs):
    path = os.environ['PATH'] + ':/usr/sbin:/sbin'
    return [name for name in programs if not shutil.which(name, path=path)]


def wait_until(what, condition, seconds=120):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f'waited {seconds} s for {what}')
        time.sleep(0.2)


class ManyJobs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix='tessera-cluster-'))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        os.makedirs(self.folder / 'out')
        lines = [{'schemaVersion': 1, 'technique': 'pattern', 'seed': seed, 'inputs': {},
                  'params': {'model': 'occupancy', 'width': 900, 'height': 900}, 'outputs': [f'out/{seed}.svg']}
                 for seed in range(1, JOBS + 1)]
        (self.folder / 'jobs.jsonl').write_text(''.join(json.dumps(line) + '\n' for line in lines))

    def results(self):
        """Line -> how often the parts' results tell it done."""
        times = collections.Counter()
        for path in self.folder.glob('shards/*.results.jsonl'):
            for line in path.read_text().splitlines(keepends=True):
                if not line.endswith('\n'):
                    continue  # being written, or its writer was killed
                entry = json.loads(line)
                self.assertEqual(entry['status'], 0, entry)
                times[entry['line']] += 1
        return times

    def check_all_is_there_once(self):
        self.assertEqual(self.results(), {line: 1 for line in range(1, JOBS + 1)})
        # What was being written where the power went is under a name of its own.
        cluster = {p.name: p.read_bytes() for p in (self.folder / 'out').iterdir()
                   if not p.name.startswith('.tessera-')}
        self.assertEqual(set(cluster), {f'{seed}.svg' for seed in range(1, JOBS + 1)})
        shutil.rmtree(self.folder / 'out')
        os.makedirs(self.folder / 'out')
        subprocess.run([PROGRAM, 'batch', 'jobs.jsonl', '--quiet'], cwd=self.folder, check=True)
        for path in (self.folder / 'out').iterdir():
            self.assertEqual(path.read_bytes(), cluster[path.name], path.name)

    def check_collected(self, done):
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('200 done, 0 failed, 0 missing, 0 done twice', done.stderr)
        self.assertEqual([json.loads(line)['line'] for line in done.stdout.splitlines()], list(range(1, JOBS + 1)))

    def collect(self):
        parts = sorted(map(str, self.folder.glob('shards/*.results.jsonl')))
        return subprocess.run(['python3', ROOT / 'examples/collect.py', 'jobs.jsonl', *parts], cwd=self.folder,
                              capture_output=True, text=True)


@unittest.skipIf(missing(SLURM), f'not there: {", ".join(missing(SLURM))} (Debian: slurm-wlm, munge)')
@unittest.skipIf(os.geteuid() != 0, 'the daemons want root')
class Slurm(ManyJobs):
    def setUp(self):
        super().setUp()
        host = os.uname().nodename
        (self.folder / 'slurm.conf').write_text(SLURM_CONF.format(host=host, folder=self.folder))
        os.makedirs(self.folder / 'state')
        key = self.folder / 'munge.key'
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.folder.chmod(0o755)
        self.environment = {**os.environ, 'SLURM_CONF': str(self.folder / 'slurm.conf'), 'TESSERA': PROGRAM,
                            'PATH': os.environ['PATH'] + ':/usr/sbin:/sbin'}
        self.daemons = {}
        self.start('munged', '--foreground', '--force', f'--key-file={key}', f'--socket={self.folder}/munge.socket',
                   f'--pid-file={self.folder}/munge.pid', f'--log-file={self.folder}/munge.log',
                   f'--seed-file={self.folder}/munge.seed')
        wait_until('munge', (self.folder / 'munge.socket').exists)
        self.start('slurmctld', '-D', '-i')
        for node in ['one', 'two']:
            self.start('slurmd', '-D', '-N', node, name=node)
        wait_until('the nodes', lambda: self.ask('sinfo', '-h', '-N', '-o', '%T').split() == ['idle', 'idle'])

    def start(self, program, *arguments, name=None):
        log = open(self.folder / f'{name or program}.out', 'wb')
        self.addCleanup(log.close)
        process = subprocess.Popen([program, *arguments], env=self.environment, cwd=self.folder, stdout=log, stderr=log,
                                   start_new_session=True)
        self.daemons[name or program] = process
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)

    def ask(self, *command):
        return subprocess.run(command, env=self.environment, cwd=self.folder, capture_output=True, text=True).stdout

    def processes_of(self, node):
        """What a node's daemon has started: first those that watch over the others and would tell how they ended."""
        watchers, workers = [], []
        for path in pathlib.Path('/proc').glob('[0-9]*'):
            with contextlib.suppress(OSError):
                environment = (path / 'environ').read_bytes()
                if f'SLURMD_NODENAME={node}'.encode() not in environment.split(b'\0'):
                    continue
                if str(self.folder).encode() not in environment:
                    continue
                workers.append(int(path.name))
                parent = pathlib.Path('/proc') / (path / 'stat').read_text().rpartition(')')[2].split()[1]
                if (parent / 'comm').read_text().strip() == 'slurmstepd':
                    watchers.append(int(parent.name))
        return watchers + workers

    def test_a_node_dies_in_the_middle(self):
        submitted = self.ask('sbatch', '--array=1-8', '--cpus-per-task=1', '--output=task-%a.log',
                             str(ROOT / 'examples/slurm/batch.sbatch'), 'jobs.jsonl')
        self.assertIn('Submitted', submitted)
        wait_until('a quarter of the jobs', lambda: sum(self.results().values()) >= JOBS // 4)
        # A node that loses its power: its daemon and all that runs there is gone at once.
        victims = self.processes_of('two')
        self.assertTrue(victims, 'it has been at work')
        self.daemons['two'].kill()
        for process in victims:
            with contextlib.suppress(ProcessLookupError):  # children go with their owners
                os.kill(process, signal.SIGKILL)
        before = sum(self.results().values())
        self.assertLess(before, JOBS)
        self.ask('scontrol', 'update', 'NodeName=two', 'State=DOWN', 'Reason=killed')
        wait_until('the queue', lambda: not self.ask('squeue', '-h').strip(), 400)
        self.check_collected(self.collect())
        self.check_all_is_there_once()


@unittest.skipIf(missing(['snakemake']), 'not there: snakemake')
class Snakemake(ManyJobs):
    def command(self):
        return ['snakemake', '--snakefile', str(ROOT / 'examples/snakemake/Snakefile'), '--cores', '2', '--config',
                f'tessera={PROGRAM}', 'shards=8', '--rerun-incomplete']

    def test_it_is_killed_in_the_middle(self):
        with open(self.folder / 'snakemake.log', 'wb') as log:
            process = subprocess.Popen(self.command(), cwd=self.folder, stdout=log, stderr=log, start_new_session=True)
        self.addCleanup(process.wait)
        wait_until('a quarter of the jobs', lambda: sum(self.results().values()) >= JOBS // 4)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        self.assertLess(sum(self.results().values()), JOBS)
        subprocess.run(['snakemake', '--snakefile', str(ROOT / 'examples/snakemake/Snakefile'), '--unlock'],
                       cwd=self.folder, capture_output=True, check=True)
        done = subprocess.run(self.command(), cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_collected(self.collect())
        collected = (self.folder / 'results.jsonl').read_text()
        self.assertEqual(collected, self.collect().stdout)
        self.check_all_is_there_once()


if __name__ == '__main__':
    unittest.main()
