//! Sails the full two hours of the noise-free scenario by the mechanisation alone and prints what it
//! loses, for a few seeds.

use insd_base::units::DEG;
use insd_simulator::simulate;
use insd_tests::noise_free::integrate;
use insd_tests::scenario;

fn main() {
    println!("seed  horizontal m  vertical m  attitude deg");
    for seed in 1..=3 {
        let loss = integrate(&simulate(&scenario(15), seed));
        let attitude = loss.attitude / DEG;
        println!("{seed:4}  {:12.3}  {:10.3}  {attitude:12.6}", loss.horizontal, loss.vertical);
    }
}
