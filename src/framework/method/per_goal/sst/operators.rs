//! The thirteen crossover operators and the mutation of the published runs (ECF, floating-point genotype).
//!
//! Symbols: parents p1, p2 and child, n genes; L, U the gene's limits; a = U(0, 1); coin: swap the parents with
//! probability 1/2; d uniform in 0..n. An operator may write values outside the limits; the caller handles them.

use crate::distance::distance;
use crate::random::RandomStream;

/// Genes closer than this (rad or m; 1e-12 degrees) count as equal in [`simulated_binary`].
const SBX_EQUAL: f64 = 1e-12 * std::f64::consts::PI / 180.0;
/// Parents closer than this (rad or m; 1e-8 degrees) define no direction for [`breeder`].
const BGA_EQUAL: f64 = 1e-8 * std::f64::consts::PI / 180.0;

/// Input of a crossover.
pub(super) struct Parents<'a> {
    pub p1: &'a [f64],
    pub p2: &'a [f64],
    /// Discrepancies of p1 and p2.
    pub fitness: [f64; 2],
    pub lower: &'a [f64],
    pub upper: &'a [f64],
    /// First gene written by the operators subject to the gene-0 quirk: 1 with the quirk, else 0.
    pub first: usize,
    /// Parents that share their memory with the child, by the shared-parent quirk.
    pub shared: [bool; 2],
}

type Crossover = fn(&Parents<'_>, &mut [f64], &mut RandomStream);

/// All crossovers; each is chosen with the same probability.
pub(super) const CROSSOVERS: [(&str, Crossover); 13] = [
    ("one_point", one_point),
    ("arithmetic", arithmetic),
    ("discrete", discrete),
    ("arithmetic_simple", arithmetic_simple),
    ("arithmetic_single", arithmetic_single),
    ("average", average),
    ("flat", flat),
    ("heuristic", flat),
    ("simulated_binary", simulated_binary),
    ("breeder", breeder),
    ("local", local),
    ("blx_alpha", blx_alpha),
    ("blx_alpha_beta", blx_alpha_beta),
];

fn swapped<'a>(parents: &Parents<'a>, rng: &mut RandomStream) -> (&'a [f64], &'a [f64]) {
    if rng.coin() { (parents.p2, parents.p1) } else { (parents.p1, parents.p2) }
}

fn one_point(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    let (a, b) = swapped(parents, rng);
    let d = rng.below(child.len());
    child[..d].copy_from_slice(&a[..d]);
    child[d..].copy_from_slice(&b[d..]);
}

fn arithmetic(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    let share = rng.unit();
    let (a, b) = swapped(parents, rng);
    for (gene, value) in child.iter_mut().enumerate() {
        *value = share * a[gene] + (1.0 - share) * b[gene];
    }
}

fn discrete(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    for (gene, value) in child.iter_mut().enumerate() {
        *value = if rng.coin() { parents.p2[gene] } else { parents.p1[gene] };
    }
}

fn arithmetic_simple(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    let share = rng.unit();
    let (a, b) = swapped(parents, rng);
    let d = rng.below(child.len());
    for (gene, value) in child.iter_mut().enumerate() {
        *value = if gene < d { a[gene] } else { share * b[gene] + (1.0 - share) * a[gene] };
    }
}

fn arithmetic_single(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    let share = rng.unit();
    let (a, b) = swapped(parents, rng);
    let d = rng.below(child.len());
    child.copy_from_slice(a);
    let overwritten = parents.shared[usize::from(std::ptr::eq(b, parents.p2))];
    if !overwritten {
        child[d] = share * b[d] + (1.0 - share) * a[d];
    }
}

fn average(parents: &Parents<'_>, child: &mut [f64], _: &mut RandomStream) {
    for (gene, value) in child.iter_mut().enumerate() {
        *value = f64::midpoint(parents.p1[gene], parents.p2[gene]);
    }
}

/// Each gene uniform between the parents, independently; `heuristic` has the same distribution.
fn flat(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    for (gene, value) in child.iter_mut().enumerate().skip(parents.first) {
        let (low, high) = ordered(parents, gene);
        *value = rng.between(low, high);
    }
}

fn ordered(parents: &Parents<'_>, gene: usize) -> (f64, f64) {
    let (p1, p2) = (parents.p1[gene], parents.p2[gene]);
    (p1.min(p2), p1.max(p2))
}

/// SBX with distribution index 1: K. Deb, R. B. Agrawal, "Simulated binary crossover for continuous search space",
/// Complex Systems 9 (1995), bounded form.
fn simulated_binary(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    for (gene, value) in child.iter_mut().enumerate() {
        let (low, high) = ordered(parents, gene);
        let mean = f64::midpoint(parents.p1[gene], parents.p2[gene]);
        if high - low < SBX_EQUAL {
            *value = mean;
            continue;
        }
        let margin = (low - parents.lower[gene]).min(parents.upper[gene] - high);
        let beta = 1.0 + 2.0 * margin / (high - low);
        let alpha = 2.0 - beta.powi(-2);
        let u = 0.999 * rng.unit();
        let spread = if u <= 1.0 / alpha { (alpha * u).sqrt() } else { (1.0 / (2.0 - alpha * u)).sqrt() };
        let half = spread / 2.0 * (high - low);
        let moved = if rng.coin() { mean + half } else { mean - half };
        // With beta = 0 (a parent outside its limits by exactly half the distance) there is no spread.
        *value = if moved.is_finite() { moved } else { mean };
    }
}

/// BGA: H. Muehlenbein, D. Schlierkamp-Voosen, "Predictive models for the breeder genetic algorithm", Evolutionary
/// Computation 1 (1993), DOI 10.1162/evco.1993.1.1.25: a step from the better parent, mostly away from the worse.
fn breeder(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    let gamma: f64 = (0..16).map(|i| if rng.below(16) == 15 { 0.5_f64.powi(i) } else { 0.0 }).sum();
    let (better, worse) =
        if parents.fitness[0] < parents.fitness[1] { (parents.p1, parents.p2) } else { (parents.p2, parents.p1) };
    let apart = distance(better, worse);
    let norm = if apart < BGA_EQUAL { 1.0 } else { apart };
    for (gene, value) in child.iter_mut().enumerate() {
        let (lower, upper) = (parents.lower[gene], parents.upper[gene]);
        let range = (upper - lower) / 2.0;
        let step = range * gamma * (worse[gene] - better[gene]) / norm;
        let moved = if rng.unit() < 0.9 { better[gene] - step } else { better[gene] + step };
        *value = if moved > upper {
            better[gene] + rng.unit() * (upper - better[gene])
        } else if moved < lower {
            better[gene] - rng.unit() * (better[gene] - lower)
        } else {
            moved
        };
    }
}

fn local(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    let (a, b) = swapped(parents, rng);
    for (gene, value) in child.iter_mut().enumerate() {
        let share = rng.unit();
        *value = share * a[gene] + (1.0 - share) * b[gene];
    }
}

/// BLX-0.5: L. J. Eshelman, J. D. Schaffer, "Real-coded genetic algorithms and interval-schemata", FOGA 2 (1993).
fn blx_alpha(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    for (gene, value) in child.iter_mut().enumerate().skip(parents.first) {
        let (low, high) = ordered(parents, gene);
        let reach = 0.5 * (high - low);
        *value = rng.between(low - reach, high + reach);
    }
}

/// BLX with 0.5 beyond p1 and 0.25 beyond p2.
fn blx_alpha_beta(parents: &Parents<'_>, child: &mut [f64], rng: &mut RandomStream) {
    for (gene, value) in child.iter_mut().enumerate().skip(parents.first) {
        let (p1, p2) = (parents.p1[gene], parents.p2[gene]);
        let interval = (p1 - p2).abs();
        *value = if p1 <= p2 {
            rng.between(p1 - 0.5 * interval, p2 + 0.25 * interval)
        } else {
            rng.between(p2 - 0.25 * interval, p1 + 0.5 * interval)
        };
    }
}

/// Redraws one random gene uniformly within its limits.
pub(super) fn mutate(child: &mut [f64], lower: &[f64], upper: &[f64], rng: &mut RandomStream) {
    let gene = rng.below(child.len());
    child[gene] = rng.between(lower[gene], upper[gene]);
}
