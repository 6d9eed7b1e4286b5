//! The sweeps through any tree.
//!
//! With A, J symmetric, a the acceleration of a segment's joint and α its angular acceleration, the segment and
//! everything beyond it require at that joint
//!
//! ```text
//! force    f = A a − B α + β_f     A = m1 + ΣAₖ     B = m[r]× + Σ(Bₖ + Aₖ[cₖ]×)
//! moment   τ = J α − Bᵀ a + β_τ    J = J_own + Σ(Jₖ + (Bₖᵀ[cₖ]×) + (Bₖᵀ[cₖ]×)ᵀ − [cₖ]×Aₖ[cₖ]×)
//! ```
//!
//! where the index k marks the requirement of a child at cₖ for its parent's α. A fixed joint passes it on unchanged. A
//! hinge has no moment about its axis u, u·τ = 0, and α increases by u q̈ + ω × u q̇ across it: q̈ = g·a − h·α − b with
//! h = Ju/d, g = Bu/d, d = u·Ju, which removes the parts of A, B and J along u. A universal joint is two hinges with
//! nothing between them; their axes are at right angles, so the second d does not vanish either.
//!
//! A point mass m that slides along û, at r = r₀ + ûs, is a part of its segment's mass, which includes it at r₀. With P
//! = 1 − ûûᵀ it requires A = mP, β_f = 2mṡP(ω×û) + (Q − S)û at r; all loads on what rides on it act on the segment. The
//! segment's requirement changes by this minus m at r₀, with n = û × r₀:
//!
//! ```text
//! A −= m ûûᵀ     B += m s[û]× − m û nᵀ     J −= m (n nᵀ + r rᵀ − r₀r₀ᵀ − (r² − r₀²) 1)
//! s̈ = (Q − S)/m − û·(a + α×r + ω×(ω×r) + 2ṡ ω×û)
//! ```
//!
//! A ball joint has no moment at all and passes on only a force, f = (A − BJ⁻¹Bᵀ) a + β_f + BJ⁻¹β_τ.

use crate::motion::dynamics::{Accelerations, Wrench};
use crate::motion::kinematics::{Kinematics, Slid};
use crate::motion::layout::{Freedom, MOST_HINGES, MOST_SEGMENTS, MOST_SLIDES, Row};
use crate::motion::scalar::Scalar;
use crate::motion::skeleton::{Link, Skeleton};
use crate::motion::vector::{M3, Sym3, V3, v3};

/// Articulated-body inertia and bias force of a subtree at a joint; the columns of `coupling` are the rows of B, all in
/// space axes.
#[derive(Clone, Copy, Debug)]
struct Need<S> {
    /// A.
    mass: Sym3<S>,
    /// Bᵀ.
    coupling: M3<S>,
    /// J.
    inertia: Sym3<S>,
    /// β_f.
    force: V3<S>,
    /// β_τ.
    moment: V3<S>,
}

/// A ball joint after the inward sweep: α = `free` + (BJ⁻¹)ᵀ a.
#[derive(Clone, Copy, Debug)]
struct Loose<S> {
    free: V3<S>,
    gain: M3<S>,
}

/// A hinge after the inward sweep: q̈ = `by_force`·a − `by_moment`·α − `bias`, and the part of α other than u q̈.
#[derive(Clone, Copy, Debug)]
struct Hinge<S> {
    by_moment: V3<S>,
    by_force: V3<S>,
    bias: S,
    drift: V3<S>,
}

/// Both sweeps, with the results of the inward sweep that the outward one uses. Every number that is read was written
/// before in the same call.
#[derive(Clone, Debug)]
pub(crate) struct Sweep<S> {
    needs: [Need<S>; MOST_SEGMENTS],
    loose: [Loose<S>; MOST_SEGMENTS],
    hinges: [Hinge<S>; MOST_HINGES],
}

/// Rows of m[r]× for m r, as columns.
#[inline(always)]
fn cross_rows<S: Scalar>(r: V3<S>) -> M3<S> {
    let o = S::zero();
    M3 { x: v3(o, -r.z, r.y), y: v3(r.z, o, -r.x), z: v3(-r.y, r.x, o) }
}

/// Rows of −[c]×M for those of M, as columns.
#[inline(always)]
fn levered<S: Scalar>(c: V3<S>, m: &M3<S>) -> M3<S> {
    M3 { x: m.y * c.z - m.z * c.y, y: m.z * c.x - m.x * c.z, z: m.x * c.y - m.y * c.x }
}

impl<S: Scalar> Need<S> {
    #[inline(always)]
    fn zero() -> Self {
        let o = V3::zero();
        let none = Sym3::scaled_identity(S::zero());
        Need { mass: none, coupling: M3 { x: o, y: o, z: o }, inertia: none, force: o, moment: o }
    }

    /// Articulated inertia of a single segment, with angular velocity `w`.
    #[inline(always)]
    fn of(link: &Link<S>, axes: &M3<S>, w: V3<S>, wrench: &Wrench<S>) -> Self {
        let inertia = link.inertia.out(axes);
        let sigma = axes.out(link.sigma);
        Need {
            mass: Sym3::scaled_identity(link.mass),
            coupling: cross_rows(sigma),
            force: w.cross(w.cross(sigma)) - wrench.force,
            moment: w.cross(inertia.mul(w)) - wrench.moment,
            inertia,
        }
    }

    /// Adds that of a segment joined at `c` of this one, which has the angular velocity `w`.
    #[inline(always)]
    fn carry(&mut self, child: &Need<S>, c: V3<S>, w: V3<S>) {
        let (m, b) = (&child.mass, &child.coupling);
        let coupling = M3 { x: b.x + m.row_x().cross(c), y: b.y + m.row_y().cross(c), z: b.z + m.row_z().cross(c) };
        // what the child needs without a and α here: its joint accelerates by ω×(ω×c)
        let centripetal = w.cross(w.cross(c));
        let force = child.force + m.mul(centripetal);
        self.force += force;
        self.moment += child.moment - b.out(centripetal) + c.cross(force);
        let (lever, own) = (levered(c, &coupling), levered(c, b));
        self.mass += child.mass;
        self.inertia += Sym3 {
            xx: child.inertia.xx + lever.x.x + own.x.x,
            yy: child.inertia.yy + lever.y.y + own.y.y,
            zz: child.inertia.zz + lever.z.z + own.z.z,
            xy: child.inertia.xy + lever.x.y + own.y.x,
            xz: child.inertia.xz + lever.x.z + own.z.x,
            yz: child.inertia.yz + lever.y.z + own.z.y,
        };
        self.coupling =
            M3 { x: self.coupling.x + coupling.x, y: self.coupling.y + coupling.y, z: self.coupling.z + coupling.z };
    }

    /// Lets a point mass, part of the mass, slide under the force `drive` along its axis; the segment has the angular
    /// velocity `w`.
    #[inline(always)]
    fn slide(&mut self, mass: S, slid: &Slid<S>, w: V3<S>, drive: S) {
        let (u, way, rest, r) = (slid.axis, slid.way, slid.rest, slid.arm());
        let n = u.cross(rest);
        self.mass.add_outer(-mass, u);
        let (turned, n_m) = (cross_rows(u * (mass * way)), n * mass);
        let b = &self.coupling;
        self.coupling =
            M3 { x: b.x + turned.x - n_m * u.x, y: b.y + turned.y - n_m * u.y, z: b.z + turned.z - n_m * u.z };
        self.inertia.add_outer(-mass, n);
        self.inertia.add_outer(-mass, r);
        self.inertia.add_outer(mass, rest);
        let round = mass * (r.norm_squared() - rest.norm_squared());
        self.inertia += Sym3::scaled_identity(round);
        // what it needs without a and α
        let bias = w.cross(w.cross(r)) + w.cross(u) * (slid.speed + slid.speed);
        let force = (bias - u * u.dot(bias)) * mass + u * drive;
        let rigid = w.cross(w.cross(rest)) * mass;
        self.force += force - rigid;
        self.moment += r.cross(force) - rest.cross(rigid);
    }

    /// Releases all rotations: a ball joint.
    #[inline(always)]
    fn loosen(&mut self) -> Loose<S> {
        let (inverse, b) = (self.inertia.inverse(), &self.coupling);
        let gain = M3 { x: inverse.mul(b.x), y: inverse.mul(b.y), z: inverse.mul(b.z) };
        self.mass -= Sym3 {
            xx: gain.x.dot(b.x),
            yy: gain.y.dot(b.y),
            zz: gain.z.dot(b.z),
            xy: gain.x.dot(b.y),
            xz: gain.x.dot(b.z),
            yz: gain.y.dot(b.z),
        };
        let free = -inverse.mul(self.moment);
        *self = Need { mass: self.mass, force: self.force + gain.into_frame(self.moment), ..Need::zero() };
        Loose { free, gain }
    }

    /// Releases the rotation about `axis`; the outer side's angular acceleration about it has the part `drift`.
    #[inline(always)]
    fn release(&mut self, axis: V3<S>, drift: V3<S>) -> Hinge<S> {
        self.force -= self.coupling.into_frame(drift);
        self.moment += self.inertia.mul(drift);
        let (ju, bu) = (self.inertia.mul(axis), self.coupling.into_frame(axis));
        let inverse = S::one() / axis.dot(ju);
        let hinge =
            Hinge { by_moment: ju * inverse, by_force: bu * inverse, bias: axis.dot(self.moment) * inverse, drift };
        self.inertia.add_outer(-inverse, ju);
        self.mass.add_outer(-inverse, bu);
        let b = &self.coupling;
        self.coupling =
            M3 { x: b.x - hinge.by_moment * bu.x, y: b.y - hinge.by_moment * bu.y, z: b.z - hinge.by_moment * bu.z };
        self.force += bu * hinge.bias;
        self.moment -= ju * hinge.bias;
        hinge
    }
}

impl<S: Scalar> Sweep<S> {
    /// Empty sweep.
    #[inline(always)]
    pub(crate) fn blank() -> Self {
        let o = V3::zero();
        Sweep {
            needs: [Need::zero(); MOST_SEGMENTS],
            loose: [Loose { free: o, gain: M3 { x: o, y: o, z: o } }; MOST_SEGMENTS],
            hinges: [Hinge { by_moment: o, by_force: o, bias: S::zero(), drift: o }; MOST_HINGES],
        }
    }

    /// Accelerations of a body (index) without gravity; a guided root has those of `root`, of its joint and angular.
    #[inline(always)]
    pub(crate) fn solve(
        &mut self,
        (bodies, body): (&Skeleton<S>, usize),
        k: &Kinematics<S>,
        hinge_rate: &[S],
        (wrench, drive): (&[Wrench<S>; MOST_SEGMENTS], &[S; MOST_SLIDES]),
        root: [V3<S>; 2],
        out: &mut Accelerations<S>,
    ) {
        let segments = bodies.layout.trunks()[body].segments();
        let (first, rows) = (segments.start, &bodies.layout.rows()[segments.clone()]);
        for (n, link) in segments.clone().zip(&bodies.links[segments.clone()]) {
            self.needs[n] = Need::of(link, &k.axes[n], k.omega[n], &wrench[n]);
        }
        let slides =
            || bodies.slides[..k.sliding].iter().enumerate().filter(|(_, slide)| segments.contains(&slide.segment));
        for (i, slide) in slides() {
            let n = slide.segment;
            self.needs[n].slide(slide.mass, &k.slides[i], k.omega[n], drive[i]);
        }
        for (n, row) in segments.clone().zip(rows).rev() {
            self.reduce(n, row, k, hinge_rate);
            if let Some(parent) = row.parent {
                let need = self.needs[n];
                self.needs[parent].carry(&need, k.joint[n] - k.joint[parent], k.omega[parent]);
            }
        }
        // no force acts on the joint of a free root
        let free = &self.needs[first];
        let is_guided = bodies.layout.is_guided(body);
        out.joint[first] = if is_guided { root[0] } else { -free.mass.inverse().mul(free.force) };
        out.alpha[first] = root[1];
        for (n, row) in segments.clone().zip(rows) {
            if let Some(parent) = row.parent {
                out.carry(k, n, parent);
                out.alpha[n] = out.alpha[parent];
            }
            let a = out.joint[n];
            if matches!(row.freedom, Freedom::Ball) {
                out.alpha[n] = self.loose[n].free + self.loose[n].gain.out(a);
            }
            for i in row.hinges() {
                let hinge = &self.hinges[i];
                out.hinge[i] = hinge.by_force.dot(a) - hinge.by_moment.dot(out.alpha[n]) - hinge.bias;
                out.alpha[n] += k.hinge_axis[i] * out.hinge[i] + hinge.drift;
            }
        }
        for (i, slide) in slides() {
            out.slides[i] = S::zero();
            let [bias, _] = out.sliding(k, i, slide.segment);
            out.slides[i] = drive[i] / slide.mass - k.slides[i].axis.dot(bias);
        }
    }

    /// Force and moment of the carrying frame on a root (index) at its joint, after its tree is solved.
    #[inline(always)]
    pub(crate) fn at_root(&self, root: usize, a: V3<S>, alpha: V3<S>) -> Wrench<S> {
        let Need { mass, coupling, inertia, force, moment } = &self.needs[root];
        // f = A a − B α + β_f, τ = J α − Bᵀ a + β_τ
        Wrench {
            force: mass.mul(a) - coupling.into_frame(alpha) + *force,
            moment: inertia.mul(alpha) - coupling.out(a) + *moment,
        }
    }

    /// Reduces the articulated inertia of segment `n` to what its joint transmits.
    #[inline(always)]
    fn reduce(&mut self, n: usize, row: &Row, k: &Kinematics<S>, hinge_rate: &[S]) {
        if matches!(row.freedom, Freedom::Ball) {
            self.loose[n] = self.needs[n].loosen();
        }
        for i in row.hinges().rev() {
            // the hinges before this one carry its axis round
            let mut w = k.omega[row.parent.unwrap_or(0)];
            for (axis, rate) in k.hinge_axis[row.slot..i].iter().zip(&hinge_rate[row.slot..i]) {
                w += *axis * *rate;
            }
            let axis = k.hinge_axis[i];
            self.hinges[i] = self.needs[n].release(axis, w.cross(axis) * hinge_rate[i]);
        }
    }
}

#[cfg(test)]
mod tests;
