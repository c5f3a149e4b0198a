#!/usr/bin/env python3
"""Runs the whole-program tests.

    run.py [NAME ...]          runs all tests, or those named; FBS_BUILD is the folder of fbs, default build/release
    run.py --list              lists the names
    run.py --make-material     makes the files that the tests share; run.py alone does so when they are missing
"""
import pathlib
import sys
import unittest

import harness

SKIPPED = 77


def tests_of(file="*"):
    """{"bad_input.table": test, ...} of a file `bad_input`, or of all."""
    def walk(suite):
        for test in suite:
            if isinstance(test, unittest.TestSuite):
                yield from walk(test)
            else:
                module, _, method = test.id().split(".")
                yield module.removesuffix("_test") + "." + method.removeprefix("test_"), test
    return dict(walk(unittest.defaultTestLoader.discover(pathlib.Path(__file__).parent, file + "_test.py")))


def main(arguments):
    if arguments == ["--list"]:
        print("\n".join(tests_of()))
        return 0
    if arguments == ["--make-material"]:
        harness.make_material()
        return 0
    if not (harness.KEYED_FBS.exists() and harness.TWO_SCENES_FBS.exists()):
        harness.make_material()
    suite = unittest.TestSuite(tests_of(name.split(".")[0])[name] for name in arguments) if arguments else \
        unittest.TestSuite(tests_of().values())
    result = unittest.TextTestRunner(verbosity=2).run(suite)
    if not result.wasSuccessful():
        return 1
    return SKIPPED if len(result.skipped) == result.testsRun else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
