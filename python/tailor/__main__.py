"""The command line: ``tailor``, or ``python -m tailor``."""

import signal
import sys


def main() -> int:
    """Does what the arguments say; the exit code.

    Returns
    -------
    int
        0 done, 1 a stage failed, 2 the input or the pipeline is wrong, 130 cancelled.
    """
    from ._native import main as run

    # Ctrl-C is the command's own.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run(["tailor", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
