"""What the tests share: the command, which STARL names, to compare with."""

import os

import pytest


@pytest.fixture
def command() -> str:
    named = os.environ.get("STARL")
    if not named:
        pytest.skip("STARL names no command to compare with")
    return named
