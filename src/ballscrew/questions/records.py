"""The records of questions, of which faces make commands and addresses."""

from __future__ import annotations

from ballscrew.questions.axis import AXIS
from ballscrew.questions.compare import COMPARE
from ballscrew.questions.condition import CONDITION
from ballscrew.questions.duty import DUTY
from ballscrew.questions.optimise import OPTIMISE
from ballscrew.questions.reversal import REVERSAL
from ballscrew.questions.ripple import RIPPLE
from ballscrew.questions.select import SELECT
from ballscrew.questions.sensitivity import SENSITIVITY
from ballscrew.questions.service import SERVICE
from ballscrew.questions.warm_up import WARM_UP

QUESTIONS = (AXIS, COMPARE, CONDITION, DUTY, OPTIMISE, REVERSAL, RIPPLE, SELECT, SENSITIVITY, SERVICE, WARM_UP)
