//! Command-line values: addresses, and enums of the core with the help that `--help` prints.
//!
//! The core knows no command line, so each enum is mirrored here; a variant missing on either side does not compile.

use std::net::SocketAddr;

/// Reads an address.
///
/// # Errors
/// The form that an address has.
pub fn address(argument: &str) -> Result<SocketAddr, String> {
    let help = "give a numeric address with a port, for example 127.0.0.1:8080 or [::1]:8080";
    argument.parse().map_err(|_| help.to_owned())
}

/// `NAME of MODULE`: mirrors `crate::framework::MODULE::NAME`, variant by variant.
macro_rules! value_enum {
    ($(#[$doc:meta])* $name:ident of $module:ident { $($(#[$help:meta])* $variant:ident,)+ }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
        #[clap(rename_all = "snake_case")]
        pub enum $name {
            $($(#[$help])* $variant,)+
        }

        impl From<$name> for crate::framework::$module::$name {
            fn from(value: $name) -> Self {
                match value {
                    $($name::$variant => Self::$variant,)+
                }
            }
        }

        impl From<crate::framework::$module::$name> for $name {
            fn from(value: crate::framework::$module::$name) -> Self {
                match value {
                    $(crate::framework::$module::$name::$variant => Self::$variant,)+
                }
            }
        }
    };
}

value_enum! {
    /// How the samples of several demonstrations are combined into a goal.
    Weighting of generalization {
        /// The mean of the demonstrations' means: every demonstration counts equally. n = floor(mean duration / T_min).
        PerDemonstration,
        /// As in the authors' script: the mean of all samples in the bin, so a longer or denser demonstration weighs more.
        /// Bins are half-open, which drops each last sample. Durations are rounded up to whole seconds before averaging,
        /// their mean is rounded down, and n = floor(that / T_min).
        PerSample,
    }
}

value_enum! {
    /// How dynamic time warping (DTW) turns two feature trajectories into one discrepancy.
    Metric of recognition {
        /// One optimal path per feature, the normalised costs summed (paper eq. 4-6): each feature's distance is divided by
        /// I + J, the number of rows on both sides (Sakoe and Chiba's normaliser, the same for every path).
        SumOfFeatures,
        /// Euclidean local distance over all features jointly, one path, standard borders.
        Multivariate,
        /// Like `multivariate`, but the first row and column of the accumulated matrix hold the local distance only; the
        /// paper's published numbers use it.
        Aquila,
    }
}

value_enum! {
    /// Treatment of the clocks of a demonstration's streams.
    ClockPolicy of demonstration {
        /// Times stay as they were recorded.
        AsRecorded,
        /// Every stream is shifted to start at 0 s; for recorders whose clocks disagree.
        AlignByStart,
    }
}

value_enum! {
    /// Format of a file.
    Format of demonstration {
        /// Separated by comma, semicolon or tab, with a header line.
        Csv,
        /// Separated by spaces, without a header: id, time (s), values. YARP logs at full rate and the authors' reduced
        /// files.
        Yarp,
        /// Canonical JSON: `{name, streams: [{name, features: [{name, unit}], time_s: [..], values: [[..], ..]}]}`.
        Json,
    }
}
