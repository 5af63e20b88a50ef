//! What a BRDF claims of itself.

/// What is claimed: a claim that does not hold is a failure, what is not claimed is measured and told.
///
/// ```
/// use lobe_verify::properties::Claims;
/// // A lobe that is known to gain energy, and is otherwise as it should be.
/// let claims = Claims { energy: false, ..Claims::LOBE };
/// assert!(claims.finite && !claims.energy);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claims {
    /// The smallest cosine that anything is claimed for; no smaller one is tried. Positive.
    pub grazing: f64,
    /// Neither NaN nor infinite.
    pub finite: bool,
    /// Not below 0.
    pub non_negative: bool,
    /// 0 where a direction is on the horizon or below it.
    pub below_horizon: bool,
    /// `f(l, v) = f(v, l)` to so many ulps of the subject's number type; 0 for the same bits.
    pub reciprocal: Option<f64>,
    /// Both directions turned around the normal give the same, to so many ulps beyond what the rounding of the turned
    /// directions explains.
    pub isotropic: Option<f64>,
    /// The form with the cosine is `f_r · n·l`, to so many ulps.
    pub cosine: Option<f64>,
    /// No jump above the horizon.
    pub continuous: bool,
    /// No more is reflected than arrives: `∫ f cos θ dω ≤ 1` from every direction, in both senses.
    pub energy: bool,
    /// A NaN in any component gives NaN in every channel.
    pub nan: bool,
}

impl Claims {
    /// What the trait [`Brdf`](lobe::Brdf) and the table of the lobes promise; not isotropy, which no type tells.
    pub const LOBE: Self = Self {
        grazing: 1e-20,
        finite: true,
        non_negative: true,
        below_horizon: true,
        reciprocal: Some(0.0),
        isotropic: None,
        // The product and the form of its own round apart: an error of 4e-6 each is 64 ulps.
        cosine: Some(256.0),
        continuous: true,
        energy: true,
        nan: true,
    };

    /// What physics asks of code of which nothing else is known. Not NaN, which a plain constant drops rightly, and no
    /// cosine so small that a square of it is beyond `f32`.
    pub const OTHERS: Self = Self {
        grazing: 1e-9,
        // A few operations in another order: each rounds by half an ulp.
        reciprocal: Some(64.0),
        nan: false,
        ..Self::LOBE
    };

    /// So many ulps a turn may change: an error of 1.5e-5 in `f32`, as the least accurate of the lobes have.
    pub(crate) const ISOTROPIC: f64 = 256.0;

    /// The same with isotropy claimed, to 256 ulps.
    #[must_use]
    pub const fn isotropic(self) -> Self {
        Self { isotropic: Some(Self::ISOTROPIC), ..self }
    }
}
