//! Enumerations of ours and of the messages, variant by variant in both directions: a new one does not compile until it
//! stands here.

use crate::app::model::{AppError, JobKind, ParameterType};
use crate::framework::collision::HomeContacts;
use crate::framework::constraint::{OnInfeasible, PenaltyForm, Side};
use crate::framework::demonstration::{ClockPolicy, Format, Severity};
use crate::framework::execution::{RunOutcome, Verdict};
use crate::framework::experiment::Quantity;
use crate::framework::generalization::Weighting;
use crate::framework::job::State;
use crate::framework::method::per_goal::{BoundsRule, Leader, Provenance, StopReason, VelocityClamp};
use crate::framework::method::whole_run::Prior;
use crate::framework::method::{Effects, Scope, SimulatorUse};
use crate::framework::recognition::Metric;
use crate::framework::robot::JointKind;
use crate::framework::trajectory::{LimitKind, Timing};
use crate::framework::world::SurfaceView;
use crate::grpc::proto;

/// A Rust enumeration that corresponds to one in the protocol.
pub trait Enumeration: Sized {
    /// The value of that number; `None` if it is unspecified.
    ///
    /// # Errors
    /// `Invalid` at `pointer` for a number without a value.
    fn read(pointer: &str, number: i32) -> Result<Option<Self>, AppError>;

    /// The number of the value.
    fn number(self) -> i32;
}

/// The value of that number, or the default if it is unspecified.
///
/// # Errors
/// As [`Enumeration::read`].
pub fn or_default<T: Enumeration + Default>(pointer: &str, number: i32) -> Result<T, AppError> {
    Ok(T::read(pointer, number)?.unwrap_or_default())
}

macro_rules! enumerations {
    ($($ours:ident = $message:ident, $noun:literal { $($variant:ident),+ $(,)? })+) => {
        $(
            impl Enumeration for $ours {
                fn read(pointer: &str, number: i32) -> Result<Option<Self>, AppError> {
                    match proto::$message::try_from(number) {
                        Ok(proto::$message::Unspecified) => Ok(None),
                        $(Ok(proto::$message::$variant) => Ok(Some(Self::$variant)),)+
                        Err(_) => {
                            let detail = format!("{number} is not {}", $noun);
                            Err(AppError::field(pointer, "invalid_value", detail))
                        }
                    }
                }

                fn number(self) -> i32 {
                    match self {
                        $(Self::$variant => proto::$message::$variant as i32,)+
                    }
                }
            }
        )+

        #[cfg(test)]
        mod tests {
            use super::*;

            #[test]
            fn every_value_has_its_number_and_its_name() {
                $(
                    for message in [$(proto::$message::$variant),+] {
                        let number = message as i32;
                        let value = $ours::read("/field", number).unwrap().unwrap();
                        assert_eq!(value.number(), number);
                        let json = serde_json::to_value(value).unwrap();
                        let name = message.as_str_name().to_lowercase();
                        assert!(name.ends_with(&json.as_str().unwrap().to_lowercase()), "{name} is {json} in JSON");
                    }
                    assert_eq!($ours::read("/field", 0).unwrap(), None);
                    let error = $ours::read("/field", i32::MAX).unwrap_err();
                    assert_eq!(error.details[0].pointer, "/field");
                )+
            }
        }
    };
}

enumerations! {
    Metric = Metric, "a metric" { SumOfFeatures, Multivariate, Aquila }
    Weighting = Weighting, "a weighting" { PerSample, PerDemonstration }
    Provenance = Provenance, "a provenance" { Simulated, Real, Inherited, Granule, Penalised }
    StopReason = StopReason, "a reason to stop" { Stagnation, Target, Tolerance, MaxEvaluations, Infeasible, OutOfReach, NoImprovement }
    Verdict = Verdict, "a verdict" { Reached, StoppedShort, OutOfReach }
    RunOutcome = RunOutcome, "an outcome of a run" { Complete, GoalsMissed, Invalid }
    State = JobState, "a state of a job" {
        Queued, Preparing, Running, Pausing, Paused, Interrupted, Cancelling, Cancelled,
        Succeeded, Failed,
    }
    JobKind = JobKind, "a kind of job" { Generalization, Execution, Experiment }
    JointKind = JointKind, "a kind of joint" { Revolute, Continuous, Prismatic, Fixed, Floating, Planar, Spherical }
    LimitKind = LimitKind, "a kind of limit" { Position, Velocity, Acceleration, Jerk }
    Timing = PlanTiming, "a timing" { Limits, Demonstration }
    Format = UploadFormat, "a format of files" { Csv, Yarp, Json }
    ClockPolicy = ClockPolicy, "a clock policy" { AsRecorded, AlignByStart }
    Severity = Severity, "a severity" { Error, Warning }
    SurfaceView = SurfaceView, "a view of a surface" { Percent, Cells }
    Quantity = Quantity, "a quantity" { Evaluations, Discrepancy, Painted }
    BoundsRule = BoundsRule, "a rule for bounds" { Clamp, Reflect, Open }
    VelocityClamp = VelocityClamp, "a clamp of velocities" { Both, UpperOnly }
    Leader = Leader, "a leader" { BestMemory, CurrentBest }
    Prior = Prior, "a prior" { None, Simulator }
    Side = Side, "a side" { Inside, Outside }
    HomeContacts = HomeContacts, "a treatment of contacts at home" { Exclude, Check }
    PenaltyForm = PenaltyForm, "a form of penalty" { Additive, Multiplicative }
    Scope = MethodScope, "a scope" { PerGoal, WholeRun, Chosen }
    Effects = MethodEffects, "a kind of effects" { Any, Smooth, Accumulating }
    SimulatorUse = MethodSimulatorUse, "a use of a simulator" { Never, Optional, Required }
    ParameterType = MethodParameterType, "a type of parameter" { Integer, Number, Flag, Choice }
    OnInfeasible = OnInfeasible, "a treatment of infeasible goals" { Stop, Append }
}
