//! Picks one of many in proportion to weights, in constant time.

/// An alias table (Walker 1977; built as in Vose, *A Linear Algorithm for Generating Random Numbers with a Given Distribution*, IEEE
/// TSE 17(9), 1991).
#[derive(Debug, Clone)]
pub(crate) struct Alias {
    slots: Vec<Slot>,
}

#[derive(Debug, Clone, Copy)]
struct Slot {
    /// Of `2³²`, how often the slot means itself.
    keep: u64,
    other: u32,
    probability: f32,
}

impl Alias {
    /// Weights that are not negative; none when their sum is 0 or not finite.
    pub(crate) fn new(weights: &[f64]) -> Option<Self> {
        let sum: f64 = weights.iter().sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return None;
        }
        let count = weights.len() as f64;
        let mut heights: Vec<f64> = weights.iter().map(|weight| weight / sum * count).collect();
        let mut slots: Vec<Slot> = (0..)
            .zip(weights)
            .map(|(at, weight)| Slot { keep: 1 << 32, other: at, probability: (weight / sum) as f32 })
            .collect();
        let (mut small, mut large): (Vec<u32>, Vec<u32>) =
            (0..weights.len() as u32).partition(|at| heights[*at as usize] < 1.0);
        while let (Some(low), Some(&high)) = (small.pop(), large.last()) {
            let (low, above) = (low as usize, high as usize);
            slots[low].keep = (heights[low] * 2.0_f64.powi(32)) as u64;
            slots[low].other = high;
            heights[above] -= 1.0 - heights[low];
            if heights[above] < 1.0 {
                large.pop();
                small.push(high);
            }
        }
        // What is left over stands at 1 but for rounding. An entry of weight 0 must not: it is never picked.
        for at in small {
            if slots[at as usize].probability == 0.0 {
                let some = weights.iter().position(|weight| *weight > 0.0).unwrap_or(0);
                slots[at as usize] = Slot { keep: 0, other: some as u32, ..slots[at as usize] };
            }
        }
        Some(Self { slots })
    }

    /// An entry, and the probability of it, for two numbers of 32 bits.
    #[inline]
    pub(crate) fn pick(&self, [slot, side]: [u32; 2]) -> (usize, f32) {
        let at = ((u64::from(slot) * self.slots.len() as u64) >> 32) as usize;
        let Slot { keep, other, .. } = self.slots[at];
        let at = if u64::from(side) < keep { at } else { other as usize };
        (at, self.slots[at].probability)
    }

    /// With which probability an entry is picked.
    pub(crate) fn probability(&self, entry: usize) -> f32 {
        self.slots.get(entry).map_or(0.0, |slot| slot.probability)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_picked_as_often_as_their_weights_say() {
        for weights in [
            vec![1.0],
            vec![0.0, 3.0, 0.0, 1.0],
            vec![1e-30, 1.0, 1e30, 2e30],
            (0..100).map(|at| f64::from(at * at % 37)).collect(),
            vec![0.1; 10],
        ] {
            let alias = Alias::new(&weights).expect("a sum");
            // The table itself says what is picked how often.
            let mut mass = vec![0.0; weights.len()];
            for (at, slot) in alias.slots.iter().enumerate() {
                let keep = slot.keep as f64 / 2.0_f64.powi(32) / weights.len() as f64;
                mass[at] += keep;
                mass[slot.other as usize] += 1.0 / weights.len() as f64 - keep;
            }
            let sum: f64 = weights.iter().sum();
            for (at, (mass, weight)) in mass.iter().zip(&weights).enumerate() {
                assert!((mass - weight / sum).abs() < 1e-8, "{weights:?}: {mass} {}", weight / sum);
                assert_eq!(alias.probability(at), (weight / sum) as f32);
                assert!(*weight > 0.0 || *mass == 0.0, "an entry of weight 0 is never picked");
            }
            for side in [0, 1 << 31, u32::MAX] {
                let (at, probability) = alias.pick([u32::MAX, side]);
                assert!(at < weights.len() && probability == alias.probability(at));
            }
        }
        assert!(Alias::new(&[]).is_none() && Alias::new(&[0.0]).is_none() && Alias::new(&[f64::INFINITY]).is_none());
    }
}
