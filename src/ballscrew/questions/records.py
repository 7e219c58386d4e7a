"""The records of questions, of which faces make commands and addresses."""

from __future__ import annotations

from ballscrew.questions.axis.question import AXIS
from ballscrew.questions.compare.question import COMPARE
from ballscrew.questions.condition.question import CONDITION
from ballscrew.questions.duty.question import DUTY
from ballscrew.questions.optimise.question import OPTIMISE
from ballscrew.questions.reversal.question import REVERSAL
from ballscrew.questions.ripple.question import RIPPLE
from ballscrew.questions.select.question import SELECT
from ballscrew.questions.sensitivity.question import SENSITIVITY
from ballscrew.questions.service.question import SERVICE
from ballscrew.questions.warm_up.question import WARM_UP

QUESTIONS = (AXIS, COMPARE, CONDITION, DUTY, OPTIMISE, REVERSAL, RIPPLE, SELECT, SENSITIVITY, SERVICE, WARM_UP)
