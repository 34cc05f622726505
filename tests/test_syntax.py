"""Trees of expressions in threads, with a garbage collector that interrupts them."""

import ast
import gc
import sys
import threading

import pytest

from robotics1.syntax import syntax_tree

SUM = "+".join(f"(a{i}*sin(b{i})-{i})" for i in range(30))


class Interrupting:
    """Garbage whose end runs Python code, so that another thread may go on in the middle of a tree."""

    def __init__(self):
        self.me = self

    def __del__(self):
        for _ in range(20):
            pass


@pytest.fixture
def hasty():
    interval, threshold = sys.getswitchinterval(), gc.get_threshold()
    sys.setswitchinterval(1e-6)
    gc.set_threshold(5, 5, 5)
    yield
    sys.setswitchinterval(interval)
    gc.set_threshold(*threshold)


def test_trees_made_in_threads_are_those_of_one_thread(hasty):
    trees, wanted = [], ast.dump(ast.parse(SUM, mode="eval").body)

    def make(depth):
        if depth:
            return make(depth - 1)
        Interrupting()
        return syntax_tree(SUM)

    def run(depth):
        for _ in range(60):
            Interrupting()
            trees.append(make(depth))

    threads = [threading.Thread(target=run, args=(3 * k,)) for k in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(trees) == 360
    assert {ast.dump(tree) for tree in trees[::20]} == {wanted}
