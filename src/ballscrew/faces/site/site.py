"""The static page as files: a folder for any web server, or one HTML file."""

from __future__ import annotations

import base64
import hashlib
import json
import re
from collections.abc import Callable, Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from ballscrew.basis.atomic_files import write_whole
from ballscrew.faces.site import kinds
from ballscrew.faces.site.contents import contents
from ballscrew.faces.site.modules import Module, module_of_oils, module_of_structure, oils
