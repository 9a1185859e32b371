"""Which tests need named pipes and devices: Windows has none."""

import os

import pytest

needs_special_files = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes and devices")
