// Types of the page: the documents that the server sends are those of its OpenAPI description.

import type { components } from "./api";

type Schemas = components["schemas"];

declare global {
  type Run = Schemas["Run"];
  type Sweep = Schemas["Sweep"];
  type Checks = Schemas["Checks"];
  type AnswerLine = Schemas["Line"];
  type Compare = Schemas["Compare"];
  type BandAnswer = Schemas["Band"];
  type DutyAnswer = Schemas["Duty"];
  type WarmUpAnswer = Schemas["WarmUp"];
  type ReversalAnswer = Schemas["Reversal"];
  type RippleAnswer = Schemas["Ripple"];
  type ChainAnswer = Schemas["Chain"];
  type Vocabulary = Schemas["Vocabulary"];
  type UnitChoice = Schemas["UnitChoice"];
  type Mechanisms = Vocabulary["mechanisms"];
  type VerdictRecord = Schemas["Record"];
  type DrawingAnswer = Schemas["Drawing"];
  type ProblemDocument = Schemas["Problem"];
  type FaultLine = Schemas["FaultLine"];
  type CatalogueRow = Schemas["Row"];
  type OwnNutAnswer = Schemas["OwnNut"];
  type Opened = Schemas["Opened"];
  type LogAnswer = Schemas["Log"];
  type FitAnswer = Schemas["Fit"];
  type ConditionAnswer = Schemas["Condition"];
  type OptimiseAnswer = Schemas["Optimise"];
  type SensitivityAnswer = Schemas["Sensitivity"];
  type ServiceAnswer = Schemas["Service"];
  type HandOverAnswer = Schemas["HandOver"];
  type Targets = Schemas["Targets"];
  type Examples = Schemas["Examples"];
  type Select = Schemas["Select"];
  type JobDocument = Schemas["Job"];
  type SelectPlan = Schemas["Plan"];
  type CaseModule = Schemas["CaseModule"];

  var SwaggerUIBundle: (options: object) => void;
}
