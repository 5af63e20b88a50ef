//! Millions of relative errors in a few kilobytes.

/// Counts of errors, each to within 1/128 of itself.
#[derive(Clone, Debug)]
pub(crate) struct Histogram {
    /// One bin for each pattern of the upper sixteen bits of a positive `f32`.
    bins: Vec<u64>,
    count: u64,
}

impl Histogram {
    pub(crate) fn new() -> Self {
        Self { bins: vec![0; 1 << 15], count: 0 }
    }

    /// Counts an error; NaN counts as the largest.
    pub(crate) fn add(&mut self, error: f64) {
        let bits = (error.abs() as f32).to_bits() >> 16;
        if let Some(bin) = self.bins.get_mut(bits as usize) {
            *bin += 1;
            self.count += 1;
        }
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        for (a, b) in self.bins.iter_mut().zip(&other.bins) {
            *a += b;
        }
        self.count += other.count;
    }

    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// That part of the errors is at most this: the upper edge of the bin, and so never too small. 0 where there are
    /// none.
    pub(crate) fn quantile(&self, part: f64) -> f64 {
        let rank = (self.count as f64 * part).ceil().max(1.0) as u64;
        let mut seen = 0;
        for (bits, bin) in (0_u32..).zip(&self.bins) {
            seen += bin;
            if seen >= rank {
                // What the first bin holds is below 1e-40 and counts as no error.
                return if bits == 0 { 0.0 } else { f64::from(f32::from_bits((bits + 1) << 16)) };
            }
        }
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_the_ranks_to_a_hundredth() {
        let mut histogram = Histogram::new();
        assert_eq!(histogram.quantile(0.5), 0.0);
        for i in 1..=1000 {
            histogram.add(f64::from(i) * 1e-9);
        }
        for (part, rank) in [(0.5, 500.0), (0.99, 990.0), (1.0, 1000.0)] {
            let ratio = histogram.quantile(part) / (rank * 1e-9);
            assert!((1.0..1.01).contains(&ratio), "{part}: {ratio}");
        }
        let mut twice = histogram.clone();
        twice.merge(&histogram);
        assert_eq!((twice.count(), twice.quantile(0.5)), (2000, histogram.quantile(0.5)));
    }
}
