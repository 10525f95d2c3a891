//! Links that are led by hand: each a mass in a viscous medium, without a spring.

use super::config::YieldConfig;
use crate::body::DVec3;

/// Speed below which a link that nobody leads rests, m/s.
const RESTS_M_S: f64 = 1e-3;

/// A link that is led.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Led {
    /// Number of the link.
    pub link: usize,
    /// Place in the link's frame at which it is led, m.
    pub at: DVec3,
    /// Velocity of this place in the base, m/s.
    pub velocity: DVec3,
}

/// A force that leads a link: the place in the link's frame, m, and the force on the robot in the base, N.
#[derive(Debug, Clone, Copy)]
pub(super) struct LeadingForce {
    pub link: usize,
    pub at: DVec3,
    pub force: DVec3,
}

/// Advances all links by so many seconds under these forces, exactly, however long a cycle is.
pub(super) fn advance(led: &mut Vec<Led>, forces: &[LeadingForce], config: &YieldConfig, seconds: f64) {
    for force in forces {
        if !led.iter().any(|it| it.link == force.link) {
            led.push(Led { link: force.link, at: force.at, velocity: DVec3::ZERO });
        }
    }
    let led_decay = (-config.damping * seconds / config.mass).exp();
    let free_decay = (-seconds / config.rest_s).exp();
    for it in led.iter_mut() {
        let own = || forces.iter().filter(|force| force.link == it.link);
        let sizes: f64 = own().map(|force| force.force.length()).sum();
        if sizes > 0.0 {
            it.at = own().map(|force| force.at * force.force.length()).sum::<DVec3>() / sizes;
        }
        let decay = if sizes > 0.0 { led_decay } else { free_decay };
        let steady = own().map(|force| force.force).sum::<DVec3>() / config.damping;
        it.velocity = (steady + (it.velocity - steady) * decay).clamp_length_max(config.speed);
    }
    let is_led = |it: &Led| forces.iter().any(|force| force.link == it.link);
    led.retain(|it| is_led(it) || it.velocity.length() > RESTS_M_S);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_hand_leads_steadily_and_leaves_it_at_rest() {
        let (config, mut led) = (YieldConfig::default(), Vec::new());
        let force = LeadingForce { link: 3, at: DVec3::Z, force: DVec3::X * 0.2 * config.damping };
        for _ in 0..1000 {
            advance(&mut led, &[force], &config, 0.005);
        }
        assert!((led[0].velocity - DVec3::X * 0.2).length() < 1e-4 && led[0].at == DVec3::Z);
        // Let go: a hundredth of the speed after 0.2 s.
        advance(&mut led, &[], &config, 0.2);
        assert!(led.is_empty() || led[0].velocity.length() < 0.002, "{led:?}");
        advance(&mut led, &[], &config, 0.2);
        assert!(led.is_empty());
    }
}
