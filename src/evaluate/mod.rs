//! Evaluators behind the Evaluator port.
