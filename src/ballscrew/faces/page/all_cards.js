// The cards of the page: what sets each up, by the name of its place.

import { setUp as askedByButton } from "./cards/asked_by_button.js";
import { setUp as axis } from "./cards/axis.js";
import { setUp as calibrate } from "./cards/calibrate.js";
import { setUp as choose } from "./cards/choose.js";
import { setUp as condition } from "./cards/condition.js";
import { setUp as duty } from "./cards/duty.js";
import { setUp as filesCard } from "./cards/files.js";
import { setUp as handOver } from "./cards/hand_over.js";
import { setUp as optimise } from "./cards/optimise.js";
import { setUp as overInput } from "./cards/over_input.js";
import { setUp as ownNut } from "./cards/own_nut.js";
import { setUp as service } from "./cards/service.js";
import { setUp as warmUp } from "./cards/warm_up.js";

/** @type {Record<string, (holder: HTMLElement) => import("./cards.js").Card>} */
export const SET_UPS = {
  "over-input": overInput,
  axis: axis,
  duty: duty,
  "warm-up": warmUp,
  choose: choose,
  reversal: askedByButton,
  ripple: askedByButton,
  sensitivity: askedByButton,
  calibration: calibrate,
  service: service,
  condition: condition,
  optimise: optimise,
  "hand-over": handOver,
  "own-nut": ownNut,
  files: filesCard,
};
