//! How fast a path is driven: speeds that were set, and the smooth change between them.

use crate::network::Path;

/// What drivers gain and lose in speed without thinking of it, m/s².
pub const COMFORTABLE_M_S2: f64 = 1.2;

impl Path {
    /// The speed that holds at a station, km/h: the one that was set last there, else that of the cross-section.
    #[must_use]
    pub fn speed_limit_kmh(&self, station_m: f64) -> f64 {
        let zone = self.speeds.iter().rev().find(|z| (z.from_m..=z.to_m).contains(&station_m));
        zone.map_or(self.section.speed_kmh, |z| z.kmh)
    }

    /// Where the speed that holds changes, and to what, by ascending station; the first is at the start.
    #[must_use]
    pub fn speed_limits(&self) -> Vec<(f64, f64)> {
        let length = self.length_m();
        let mut borders: Vec<f64> = self.speeds.iter().flat_map(|z| [z.from_m, z.to_m]).collect();
        borders.retain(|s| (0.0..length).contains(s));
        borders.push(0.0);
        borders.push(length);
        borders.sort_by(f64::total_cmp);
        borders.dedup();
        let mut limits: Vec<(f64, f64)> = Vec::new();
        for pair in borders.windows(2) {
            let kmh = self.speed_limit_kmh(0.5 * (pair[0] + pair[1]));
            if limits.last().is_none_or(|(_, last)| *last != kmh) {
                limits.push((pair[0], kmh));
            }
        }
        limits
    }
}

/// Speeds at stations, m/s, that are nowhere above `limits_m_s` and change by no more than `most_m_s2`: the fastest such. Stations ascend.
#[must_use]
pub fn smooth_speeds(stations_m: &[f64], limits_m_s: &[f64], most_m_s2: f64) -> Vec<f64> {
    let mut squares: Vec<f64> = limits_m_s.iter().map(|v| v * v).collect();
    // v² changes by 2a for each metre.
    for i in 1..squares.len() {
        let most = squares[i - 1] + 2.0 * most_m_s2 * (stations_m[i] - stations_m[i - 1]);
        squares[i] = squares[i].min(most);
    }
    for i in (1..squares.len()).rev() {
        let most = squares[i] + 2.0 * most_m_s2 * (stations_m[i] - stations_m[i - 1]);
        squares[i - 1] = squares[i - 1].min(most);
    }
    squares.into_iter().map(f64::sqrt).collect()
}
