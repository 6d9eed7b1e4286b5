//! Quantities with limits in rules.

/// A limited quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// HIC15.
    Hic15,
    /// HIC36, HPC.
    Hic36,
    /// Cumulative 3 ms level of the head, m/s².
    HeadThreeMsCumulative,
    /// Nij.
    Nij,
    /// Neck tension, N.
    NeckTension,
    /// Neck compression as a positive number, N.
    NeckCompression,
    /// Cumulative 3 ms level of the chest, m/s².
    ChestThreeMsCumulative,
    /// Deflection of the sternum, or of the deepest point of a chest, m.
    ChestDeflection,
    /// Viscous criterion of the chest in frontal impact, m/s.
    ViscousCriterion,
    /// Femur axial compression as a positive number, N.
    FemurAxial,
    /// Femur force over the R94 curve that falls with duration.
    FemurDurationUse,
    /// GSI or CSI.
    SeverityIndex,
    /// Occupant impact velocity, each component, m/s.
    OccupantImpactVelocity,
    /// Occupant impact velocity, longitudinal, m/s; the rule has no lateral limit.
    LongitudinalImpactVelocity,
    /// Occupant ridedown acceleration, each component, m/s².
    RidedownAcceleration,
    /// Acceleration severity index.
    Asi,
    /// Theoretical head impact velocity, m/s.
    Thiv,
    /// Post-impact head deceleration, m/s².
    Phd,
    /// Largest roll angle, rad.
    Roll,
    /// Largest pitch angle, rad.
    Pitch,
    /// Largest rate of deflection of the sternum, m/s.
    DeflectionRate,
    /// Tibia index.
    TibiaIndex,
    /// Tibia axial compression as a positive number, N.
    TibiaAxial,
    /// Deflection of the deepest chest rib in side impact, m.
    RibDeflection,
    /// Viscous criterion of a chest or abdominal rib in side impact, m/s.
    RibViscousCriterion,
    /// Deflection of the deeper abdominal rib, m.
    AbdomenRibDeflection,
    /// Force of the abdomen: sum of its cells, N.
    AbdomenForce,
    /// Lateral force of the shoulder, N.
    ShoulderForce,
    /// Force of the pubic symphysis, N.
    PubicForce,
    /// Force of the pelvis: sum of acetabulum and ilium, N.
    PelvisForce,
    /// Largest resultant acceleration of the lower spine, m/s².
    LowerSpinePeak,
    /// Cumulative 3 ms level of the lower spine (T12), m/s².
    LowerSpineThreeMsCumulative,
    /// Neck injury criterion of whiplash, m²/s².
    Nic,
    /// Nkm.
    Nkm,
    /// Speed of the head's rebound, m/s.
    ReboundSpeed,
    /// Shear of the upper neck that pushes the head forward, N.
    NeckShearAhead,
    /// Forward acceleration of T1, m/s².
    T1Acceleration,
    /// Time of the head's contact with its restraint, s.
    HeadContactTime,
}
