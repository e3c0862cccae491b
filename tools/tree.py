"""What the tools have in common: the tree that they lie in, its program, and its commit."""
import os, pathlib, shutil, subprocess, sys

root = pathlib.Path(__file__).resolve().parent.parent

# $CLOTHSIM, as whoever called the tool sees it, or what tools/build makes. Commands may run in another folder.
program = os.environ.get("CLOTHSIM") or str(root / "build/release/clothsim")
program = os.path.abspath(shutil.which(program) or program)


def git(*words):
    return subprocess.run(["git", "-C", root, *words], check=True, capture_output=True, text=True).stdout.strip()


def commit(*paths):
    """That of the tree, with a + where these paths have changed since; by default what a result depends on."""
    try:
        name, changed = git("rev-parse", "--short", "HEAD"), git("diff", "--stat", "HEAD", "--", *(paths or ("src", "shaders", "assets/scenes")))
    except (OSError, subprocess.CalledProcessError):
        return "unknown"  # a copy of the tree on a machine that is lent
    return name + ("+" if changed else "")


def no_arguments(doc):
    """Of a tool that takes none: it tells what it does when it is asked, and refuses everything else."""
    if not sys.argv[1:]:
        return
    asked = sys.argv[1:] in (["-h"], ["--help"])
    print(doc.strip(), file=sys.stdout if asked else sys.stderr)
    sys.exit(0 if asked else 2)
