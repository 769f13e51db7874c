"""The man page and the shells' completions, by the programs that read them. TESSERA names the program."""
import json
import shutil
import subprocess
import unittest

from cli import CliTest

BASH = """
source tessera.bash
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_tessera
printf '%s\\n' "${COMPREPLY[@]}"
"""
# zsh completes only where somebody types: a pseudo terminal of its own.
ZSH = """
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell 'PS1=; autoload -U compinit; compinit -u -d ./dump; source ./tessera.zsh; zstyle ":completion:*" list-colors ""'
zpty -w shell 'tell() { zle -I; print -r -- "<$BUFFER>" }; zle -N tell; bindkey "^I" complete-word "^T" tell; echo READ""Y'
zpty -r shell line '*READY*'
zpty -n -w shell "$1"$'\\t\\x14'
zpty -r shell line '*<*>*'
print -r -- "$line"
"""


def needs(program):
    return unittest.skipUnless(shutil.which(program), f'there is no {program}')


class Shells(CliTest):
    def script(self, shell):
        name = f'tessera.{shell}'
        self.put(name, self.succeed('completion', shell).stdout)
        return name

    def run_shell(self, *command):
        done = subprocess.run(command, cwd=self.folder, capture_output=True, timeout=60)
        self.assertEqual(done.stderr.decode(), '')
        return done.stdout.decode()

    def test_an_unknown_shell(self):
        self.fail_with(2, 'completion', 'ksh', says=['SHELL', 'ksh', 'bash, zsh or fish'])
        self.fail_with(2, 'completion', says=['SHELL'])

    def bash(self, *words):
        self.script('bash')
        return self.run_shell('bash', '-c', BASH, 'tessera', *words).split()

    @needs('bash')
    def test_bash(self):
        self.assertEqual(self.bash('tessera', 'pa'), ['pave', 'pattern', 'parquet'])
        self.assertEqual(self.bash('tessera', 'pave', '--ha'), ['--half-side'])
        self.assertEqual(self.bash('tessera', 'pave', 'a b.png', '--backend', ''), ['auto', 'cpu', 'gl'])
        self.assertEqual(self.bash('tessera', 'pave', '--backend', '=', 'c'), ['cpu'])
        self.assertEqual(self.bash('tessera', 'pave', '--backend', '='), ['auto', 'cpu', 'gl'])
        self.assertEqual(self.bash('tessera', 'pattern', 'occ'), ['occupancy'])
        self.assertEqual(self.bash('tessera', 'completion', ''), ['bash', 'zsh', 'fish'])
        for files in [['pave', ''], ['pave', '-o', ''], ['run', 'jo']]:
            self.assertEqual(self.bash('tessera', *files), [], 'the shell completes files')

    @needs('bash')
    def test_bash_knows_every_parameter(self):
        schema = json.loads(self.succeed('schema', 'mosaic').stdout)
        flags = self.bash('tessera', 'mosaic', '--')
        for key in schema['properties']:
            self.assertIn('--' + ''.join('-' + c.lower() if c.isupper() else c for c in key), flags)

    @needs('fish')
    def test_fish(self):
        name = self.script('fish')

        def fish(line):
            told = self.run_shell('fish', '--no-config', '-c', f'source {name}; complete -C "{line}"')
            return [entry.split('\t')[0] for entry in told.splitlines()]

        self.assertEqual(fish('tessera pave --ha'), ['--half-side'])
        self.assertEqual(sorted(fish('tessera pave --backend ')), ['auto', 'cpu', 'gl'])
        self.assertIn('pattern', fish('tessera pa'))

    @needs('zsh')
    def test_zsh(self):
        self.script('zsh')
        self.run_shell('zsh', '-n', 'tessera.zsh')
        for line, completed in [('pave --hal', 'pave --half-side='), ('pave --backend g', 'pave --backend gl '), ('patte', 'pattern ')]:
            told = self.run_shell('zsh', '-f', '-c', ZSH, 'zsh', f'tessera {line}')
            self.assertIn(f'<tessera {completed}>', told)


class ManPage(CliTest):
    def page(self):
        return self.put('tessera.1', self.succeed('schema', '--man').stdout)

    @needs('groff')
    def test_roff_is_without_warnings(self):
        done = subprocess.run(['groff', '-man', '-k', '-ww', '-Tutf8', str(self.page())], capture_output=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr.decode()), (0, ''))

    @needs('mandoc')
    def test_mandoc_finds_nothing_but_the_missing_date(self):
        """Same version, same bytes: the page has no date."""
        done = subprocess.run(['mandoc', '-Tlint', '-W', 'warning', str(self.page())], capture_output=True, timeout=60)
        complaints = [line for line in done.stdout.decode().splitlines() if 'missing date' not in line]
        self.assertEqual(complaints, [])

    def test_names_every_command_and_flag(self):
        page = self.page().read_text().replace('\\-', '-')
        commands = [line.split()[0] for line in
                    self.succeed('--help').stdout.decode().split('Subcommands:')[1].splitlines() if line.strip()]
        for command in commands:
            self.assertIn(f'.SH "TESSERA {command.upper()}"', page)
        for about in json.loads(self.succeed('schema').stdout)['$defs'].values():
            for key in about['properties']:
                flag = ''.join('-' + c.lower() if c.isupper() else c for c in key)
                self.assertIn(f'\\fB--{flag}\\fR', page)


if __name__ == '__main__':
    unittest.main()
