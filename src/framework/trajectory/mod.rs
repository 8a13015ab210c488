//! Trajectories: time parameterisation, check, export.
