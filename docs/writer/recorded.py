"""Be another program, and write what it reads: ``recorded RECORD MODULE ARGUMENTS``, in a fork of ``libraries``."""

import runpy
import sys

import reads

if __name__ == "__main__":
    record, module, *arguments = sys.argv[1:]
    reads.write_to(record)
    sys.argv = [module, *arguments]
    runpy.run_module(module, run_name="__main__", alter_sys=True)
