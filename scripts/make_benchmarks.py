#!/usr/bin/env python3
"""Writes docs/benchmarks.md from what tessera_bench has measured.

    build/native-release/bin/tessera_bench --benchmark_format=json >results.json
    scripts/make_benchmarks.py results.json

Several files of results, of --benchmark_filter, are taken as one.

What each benchmark is, the comment at the head of its source says.
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
MEASURED_BY_LIBRARY = {
    'name', 'family_index', 'per_family_instance_index', 'run_name', 'run_type', 'repetitions', 'repetition_index', 'threads',
    'iterations', 'real_time', 'cpu_time', 'time_unit', 'aggregate_name', 'aggregate_unit', 'big_o', 'cpu_coefficient',
    'real_coefficient', 'rms'}
SECONDS = {'s': 1, 'ms': 1e-3, 'us': 1e-6, 'ns': 1e-9}
INTRODUCTION = """# Benchmarks

Made by `scripts/make_benchmarks.py` from a run of `build/native-release/bin/tessera_bench --benchmark_format=json`, on {cpus}
processor{s} of {mhz} MHz, one thread, Release, version {version}. Times are the processor's, of one run; those of another
machine differ, so that what grows with what is the figure to look at.
"""


def sources():
    """Of each source: its title, what its head says, and the names of its benchmarks."""
    for path in sorted((ROOT / 'bench').glob('*_bench.cpp')):
        text = path.read_text(encoding='utf-8')
        head = ' '.join(line[3:] for line in re.match(r'(?://[^\n]*\n)+', text)[0].splitlines())
        yield path.stem.removesuffix('_bench').capitalize(), head, re.findall(r'^BENCHMARK(?:_CAPTURE)?\((\w+)', text, re.MULTILINE)


def shown_time(seconds):
    for unit, factor in SECONDS.items():
        if seconds >= factor:
            return f'{seconds / factor:.3g} {unit}'
    return '0'


def shown_number(number):
    return f'{number:.0f}' if abs(number) >= 1000 or number == round(number) else f'{number:.3g}'


def name_of(result):
    return result['run_name'].split('/')[0]


def row(result):
    name = result['run_name'].removesuffix('/iterations:1')
    if result.get('aggregate_name') == 'BigO':
        return f'| `{name}` | fits {result["big_o"]} best | |'
    if result.get('aggregate_name'):
        return None
    counted = ', '.join(f'{shown_number(value)} {key.replace("_", " ")}' for key, value in result.items() if key not in MEASURED_BY_LIBRARY)
    return f'| `{name}` | {shown_time(result["cpu_time"] * SECONDS[result["time_unit"]])} | {counted} |'


def page(context, benchmarks):
    version = (ROOT / 'VERSION').read_text(encoding='utf-8').strip()
    parts = [INTRODUCTION.format(cpus=context['num_cpus'], s='s' if context['num_cpus'] > 1 else '', mhz=context['mhz_per_cpu'], version=version)]
    for title, head, names in sources():
        rows = [row(result) for result in benchmarks if name_of(result) in names]
        parts.append(f'## {title}\n\n{head}\n\n| Benchmark | Time | Counted |\n|---|---|---|\n' + '\n'.join(filter(None, rows)) + '\n')
        missing = [f'`{name}`' for name in names if name not in map(name_of, benchmarks)]
        if missing:
            parts.append(f'Not measured in this run: {", ".join(dict.fromkeys(missing))}.\n')
    return '\n'.join(parts)


if __name__ == '__main__':
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    runs = [json.loads(pathlib.Path(path).read_text(encoding='utf-8')) for path in sys.argv[1:]]
    text = page(runs[0]['context'], [result for run in runs for result in run['benchmarks']])
    (ROOT / 'docs/benchmarks.md').write_text(text, encoding='utf-8')
