//! Branch and bound over a box: halve what cannot be judged, until everything is or the effort is spent.

use super::{Axis, Counterexample, Effort, Open, Outcome, Recheck};
use crate::interval::Interval;
use rayon::prelude::*;

/// What is found out about one box.
pub(super) enum Verdict {
    /// Within the limits.
    Proved {
        /// The bound of the value.
        bound: Interval,
        /// How its cells are cut, if it has any.
        cells: String,
        /// How many they are.
        count: usize,
    },
    /// A point that violates them, and the bound of the value there.
    Refuted(Vec<f64>, Interval),
    /// Not known: the bound, the axis along which to halve it, and the cells that were computed.
    Unknown(Interval, usize, usize),
}

impl Verdict {
    /// The cells that were computed.
    fn cells(&self) -> usize {
        match self {
            Self::Proved { count, .. } | Self::Unknown(_, _, count) => *count,
            Self::Refuted(..) => 0,
        }
    }
}

/// A node of the subdivision.
enum Node {
    Proved(Interval, String),
    Open(Vec<Interval>, Interval),
    Halved(usize, usize),
    Waiting,
}

/// The statement, as far as the search must know it.
pub(super) struct Statement<'a> {
    pub(super) name: &'a str,
    pub(super) axes: &'a [Axis],
    pub(super) limits: (f64, f64),
}

/// Below this share of an axis a box is not halved any more: what is not within the limits there never will be.
const LEAST_SHARE: f64 = 1.0 / (1u64 << 30) as f64;

/// Judges the whole box, of at most ten axes, and then the halves of what is not known, level by level: all boxes of a level in parallel, and
/// the same boxes whatever the number of threads.
pub(super) fn search(
    statement: &Statement<'_>,
    effort: &Effort,
    judge: impl Fn(&[Interval]) -> Verdict + Sync,
) -> Outcome {
    let Statement { name, axes, limits } = *statement;
    let mut nodes = vec![Node::Waiting];
    // A proof names an axis by one digit.
    if axes.len() > 10 {
        let (name, axes, bound) = (name.to_owned(), axes.to_vec(), Interval::UNKNOWN);
        let region = axes.iter().map(Axis::whole).collect();
        return Outcome::Open(Open { name, axes, limits, region, bound, open: 1, boxes: 0, cells: 0 });
    }
    let mut level: Vec<(usize, Vec<Interval>)> = vec![(0, axes.iter().map(Axis::whole).collect())];
    let (mut boxes, mut cells, mut spent) = (0, 0, 0);
    while !level.is_empty() {
        spent += level.len();
        let verdicts: Vec<_> = level.par_iter().map(|(_, region)| judge(region)).collect();
        spent += verdicts.iter().map(Verdict::cells).sum::<usize>();
        let unknown = verdicts.iter().filter(|v| matches!(v, Verdict::Unknown(..))).count();
        let enough = spent + 2 * unknown <= effort.work;
        let mut next = Vec::new();
        for ((id, region), verdict) in level.into_iter().zip(verdicts) {
            match verdict {
                Verdict::Proved { bound, cells: cut, count } => {
                    boxes += 1;
                    cells += count;
                    nodes[id] = Node::Proved(bound, cut);
                }
                Verdict::Refuted(point, value) => {
                    let (name, axes) = (name.to_owned(), axes.to_vec());
                    return Outcome::Refuted(Counterexample { name, axes, limits, point, value });
                }
                Verdict::Unknown(bound, axis, _) => {
                    if !enough || axes[axis].share(region[axis]) < LEAST_SHARE {
                        nodes[id] = Node::Open(region, bound);
                        continue;
                    }
                    let (lower, upper) = axes[axis].halves(region[axis]);
                    nodes[id] = Node::Halved(axis, nodes.len());
                    for half in [lower, upper] {
                        let mut child = region.clone();
                        child[axis] = half;
                        next.push((nodes.len(), child));
                        nodes.push(Node::Waiting);
                    }
                }
            }
        }
        level = next;
    }
    let excess = |bound: &Interval| match bound.is_finite() {
        true => f64::max(bound.hi - limits.1, limits.0 - bound.lo),
        false => f64::INFINITY,
    };
    let open = nodes.iter().filter_map(|node| match node {
        Node::Open(region, bound) => Some((region, *bound)),
        _ => None,
    });
    let count = open.clone().count();
    if let Some((region, bound)) = open.max_by(|a, b| excess(&a.1).total_cmp(&excess(&b.1))) {
        let (name, axes, region) = (name.to_owned(), axes.to_vec(), region.clone());
        return Outcome::Open(Open { name, axes, limits, region, bound, open: count, boxes, cells: spent });
    }
    let mut proof = String::new();
    let mut bound = (f64::INFINITY, f64::NEG_INFINITY);
    // In the order of a text: a node, its lower half, its upper half.
    let mut stack = vec![0];
    while let Some(id) = stack.pop() {
        match &nodes[id] {
            Node::Halved(axis, first) => {
                proof.push_str(&axis.to_string());
                stack.extend([first + 1, *first]);
            }
            Node::Proved(of_box, cut) => {
                bound = (bound.0.min(of_box.lo), bound.1.max(of_box.hi));
                proof.push_str(cut);
            }
            Node::Open(..) | Node::Waiting => {}
        }
    }
    let (name, axes) = (name.to_owned(), axes.to_vec());
    Outcome::Certified(super::Certificate { name, axes, limits, bound, boxes, cells, proof })
}

/// Walks through the proof, and asks of every box whether it is within the limits. `judge` is given the rest of the
/// text, and returns how much of it belongs to the box, and its bound.
pub(super) fn recheck(
    statement: &Statement<'_>,
    proof: &str,
    judge: impl Fn(&[Interval], &[u8]) -> Result<(usize, Interval), usize>,
) -> Recheck {
    let (axes, limits) = (statement.axes, statement.limits);
    let text = proof.as_bytes();
    let mut position = 0;
    let mut stack: Vec<Vec<Interval>> = vec![axes.iter().map(Axis::whole).collect()];
    while let Some(mut region) = stack.pop() {
        let Some(&symbol) = text.get(position) else {
            return Recheck::Malformed(position);
        };
        if symbol.is_ascii_digit() {
            let axis = usize::from(symbol - b'0');
            if axis >= axes.len() {
                return Recheck::Malformed(position);
            }
            position += 1;
            let (lower, upper) = axes[axis].halves(region[axis]);
            region[axis] = upper;
            stack.push(region.clone());
            region[axis] = lower;
            stack.push(region);
            continue;
        }
        match judge(&region, &text[position..]) {
            Ok((length, bound)) if within(bound, limits) => position += length,
            Ok((_, bound)) => return Recheck::Fails(region, bound),
            Err(offset) => return Recheck::Malformed(position + offset),
        }
    }
    if position == text.len() { Recheck::Holds } else { Recheck::Malformed(position) }
}

/// Whether all of the bound is within the limits, and nothing undefined.
pub(super) fn within(bound: Interval, limits: (f64, f64)) -> bool {
    bound.is_finite() && limits.0 <= bound.lo && bound.hi <= limits.1
}
