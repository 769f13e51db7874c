#!/usr/bin/env python3
"""One list of results from those of the parts of a batch.

    collect.py JOBS.jsonl PART.results.jsonl... >results.jsonl

Prints what became of each job, in the order of the jobs. Says on standard error how many are done, and ends with 1
unless each is done, and once. A job that failed and was done later counts as done.
"""
import hashlib
import json
import sys


def jobs_in(path):
    """Line -> checksum of the job there."""
    with open(path, 'rb') as file:
        return {number: hashlib.sha256(line.rstrip(b'\n')).hexdigest() for number, line in enumerate(file, 1) if line.strip()}


def entries_in(paths):
    for path in paths:
        with open(path, encoding='utf-8') as file:
            for line in file:
                if line.endswith('\n'):  # else its writer was stopped
                    yield json.loads(line)


def main(jobs_path, *parts):
    jobs = jobs_in(jobs_path)
    last, done = {}, {}
    for entry in entries_in(parts):
        line = entry['line']
        if jobs.get(line) != entry['sha256']:
            continue  # of another list of jobs
        if entry['status'] == 0 or last.get(line, {'status': 1})['status'] != 0:
            last[line] = entry
        done[line] = done.get(line, 0) + (entry['status'] == 0)
    for line in sorted(last):
        print(json.dumps(last[line], ensure_ascii=False))
    failed = sum(entry['status'] != 0 for entry in last.values())
    missing = [line for line in jobs if line not in last]
    twice = [line for line in done if done[line] > 1]
    print(f'{len(jobs)} jobs: {len(last) - failed} done, {failed} failed, {len(missing)} missing, {len(twice)} done twice',
          file=sys.stderr)
    return 1 if failed or missing or twice else 0


if __name__ == '__main__':
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
