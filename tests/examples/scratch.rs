//! scratch
use insd_base::{earth, Truth};
use insd_nav::strapdown::LocalGravity;
use insd_nav::{Conditioned, Conditioner, Nominal, Increment};
use insd_simulator::simulate;
use insd_tests::scenario;
use nalgebra::UnitQuaternion;
fn at(t: &Truth) -> Nominal { Nominal::at(&t.position, &t.velocity.unwrap().0, &t.attitude.unwrap().c_nb()) }
fn integrate(nominal: &mut Nominal, gravity: &LocalGravity, increment: &Increment, fix: bool, hold: Option<f64>) {
    let h = increment.duration();
    let rotation = increment.rotation; let velocity = increment.velocity;
    let earth_turn = earth::rate_e() * h;
    let half_turn = UnitQuaternion::new(rotation * 0.5);
    let c_eb = (UnitQuaternion::new(-0.5 * earth_turn) * nominal.attitude * half_turn).to_rotation_matrix().into_inner();
    let force = c_eb * (velocity + rotation.cross(&rotation.cross(&velocity)) / 24.0);
    let old = nominal.velocity;
    let g = gravity.at(&(nominal.position + 0.5 * h * old));
    let middle = if fix { old + 0.5 * (force + g * h) } else { old + 0.5 * force };
    let pull = g - 2.0 * earth::rate_e().cross(&middle);
    nominal.velocity += force + pull * h;
    nominal.position += 0.5 * h * (old + nominal.velocity);
    nominal.attitude = UnitQuaternion::new(-earth_turn) * nominal.attitude * UnitQuaternion::new(rotation);
    let _ = hold;
}
fn main() {
    let v = simulate(&scenario(15), 1);
    for fix in [false, true] { for anchor in [1usize, 10] {
        let mut t = v.truth.iter(); let mut n = at(t.next().unwrap());
        let mut g = LocalGravity::around(&n.position, &n.geodetic());
        let mut c = Conditioner::new(&v.header.imu);
        let mut next = t.next(); let mut k = 0;
        for (i, s) in v.imu.iter().enumerate() {
            let Conditioned::Sample(inc) = c.take(&s.message) else { panic!() };
            integrate(&mut n, &g, &inc, fix, None);
            if i % anchor == anchor - 1 { n.attitude.renormalize(); g = LocalGravity::around(&n.position, &n.geodetic()); }
            while let Some(r) = next.filter(|r| r.time <= inc.to) {
                if r.time == inc.to { let x = at(r); let e = earth::c_ne(&r.position) * (n.position - x.position);
                    let ev = earth::c_ne(&r.position) * (n.velocity - x.velocity);
                    k += 1; if k % 9000 == 0 || k == 10 || k==600 || k==3000 { println!("{fix} {anchor} {:6} e {:.5} {:.5} {:.5} v {:.2e} {:.2e} {:.2e} att {:.2e}", r.time.as_seconds(), e.x, e.y, e.z, ev.x, ev.y, ev.z, (n.attitude*x.attitude.inverse()).angle()); } }
                next = t.next();
            }
        }
    } }
}
