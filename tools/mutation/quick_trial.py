"""Old fixes taken back one by one: which of their tests fail, and would ``make quick`` have chosen them?

    python tools/mutation/quick_trial.py TREE COMMIT...

``TREE`` is a work tree of this repository that may be changed. There stands each commit without its change of ``src``;
the tests that it changed are run, and those that fail are looked for among the tests that the map of ``make quick`` has
for the lines taken back. Tests that changed are not looked for: ``make quick`` takes them anyway.
"""

import os
import subprocess
import sys
from pathlib import Path

import quick


def trial(tree: Path, commit: str, budget: float) -> str:
    """A row of the table: a commit, its tests, those that fail without it, and what was chosen."""
    quick.ROOT = tree
    quick.git("checkout", "--quiet", "--force", "--detach", commit)
    quick.git("clean", "--quiet", "--force", "-d", "src", "tests")
    patch = quick.git("diff", f"{commit}^", commit, "--", "src")
    subprocess.run(("git", "apply", "--reverse"), cwd=tree, check=True, input=patch, text=True)
    changed = quick.git("diff", "--name-only", "--diff-filter=d", f"{commit}^", commit, "--", "tests").splitlines()
    files = [file for file in changed if Path(file).name.startswith("test_")]
    failing = failed(tree, files)
    functions = quick.changed_functions(quick.changed_lines("HEAD"))
    quick.git("checkout", "--quiet", "--", "src")
    failing -= failed(tree, sorted(failing))  # what fails there with it, too
    reach = quick.read_map()
    choice = quick.chosen(reach, functions, (), budget)
    found, missed = failing.intersection(choice.tests), sorted(failing.difference(choice.tests))
    why = "; ".join(f"`{test.rpartition('/')[2]}`" + " (not in the map)" * (test not in reach.tests) for test in missed)
    title = quick.git("log", "-1", "--format=`%h` %s", commit).strip().replace("|", "/")
    cells = (title, len(failing), len(found), len(choice.tests), f"{choice.seconds:.0f}", choice.left, why or "–")
    return f"| {' | '.join(map(str, cells))} |"


def failed(tree: Path, tests: list[str]) -> set[str]:
    """The tests among some, or in files, that fail with the source of a tree."""
    if not tests:
        return set()
    command = (sys.executable, "-m", "pytest", "-n0", *quick.PYTEST, "-rfE", "--tb=no", *tests)
    environment = {**os.environ, "PYTHONPATH": str(tree / "src")}
    done = subprocess.run(command, cwd=tree, env=environment, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        raise SystemExit(f"{' '.join(tests)}: the tests cannot be run\n{done.stdout[-2000:]}")
    lines = [line.split(" ", 1)[1] for line in done.stdout.splitlines() if line.startswith(("FAILED ", "ERROR "))]
    return {line.partition(" - ")[0] for line in lines}


def main() -> None:
    """Print the table as Markdown, a row as soon as it is known."""
    tree, commits = Path(sys.argv[1]).resolve(), sys.argv[2:]
    print("| without | of its tests fail | found | chosen | seconds of processor | left out | missed |")
    print("|---|--:|--:|--:|--:|--:|---|")
    for commit in commits:
        print(trial(tree, commit, 40.0 * quick.WORKERS), flush=True)


if __name__ == "__main__":
    main()
