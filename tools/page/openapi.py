"""Write the OpenAPI document of the server: the types of the page are made from it."""

import json
import sys
from pathlib import Path

from ballscrew.faces.web.openapi import document
from ballscrew.faces.web.server import application

Path(sys.argv[1]).write_text(json.dumps(document(application())), encoding="utf-8")
