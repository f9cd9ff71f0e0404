use super::*;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn planes() -> impl Strategy<Value = Image<f64>> {
    (1..14_usize, 1..14_usize).prop_flat_map(|(w, h)| {
        prop::collection::vec(-1.0..1.0_f64, w * h)
            .prop_map(move |values| Image::from_vec(w, h, values).unwrap())
    })
}

proptest! {
    #[test]
    fn the_inverse_leads_back(plane in planes()) {
        let back = Spectrum::new(plane.view(), Window::None).inverse();
        for (a, b) in back.pixels().iter().zip(plane.pixels()) {
            prop_assert!((a - b).abs() < 1e-13);
        }
    }

    #[test]
    fn parseval_holds(plane in planes()) {
        let energy: f64 = plane.pixels().iter().map(|v| v * v).sum();
        let spectrum = Spectrum::new(plane.view(), Window::None);
        prop_assert!((spectrum.energy(|_| true) - energy).abs() < 1e-11);
        let (low, high) =
            (spectrum.energy(|f| f.radius() < 0.3), spectrum.energy(|f| f.radius() >= 0.3));
        prop_assert!((low + high - energy).abs() < 1e-11);
    }

    #[test]
    fn a_real_plane_has_a_symmetric_spectrum(plane in planes(), k in -20..20_isize, l in -20..20_isize) {
        let spectrum = Spectrum::new(plane.view(), Window::None);
        prop_assert!((spectrum.bin(k, l) - spectrum.bin(-k, -l).conj()).norm() < 1e-11);
    }

    #[test]
    fn it_is_the_sum_by_its_definition(plane in planes(), k in 0..14_usize, l in 0..14_usize) {
        let (w, h) = (plane.width(), plane.height());
        let mut sum = Complex::new(0.0, 0.0);
        for y in 0..h {
            for x in 0..w {
                let turns = (k * x) as f64 / w as f64 + (l * y) as f64 / h as f64;
                sum += Complex::from_polar(plane.row(y)[x], -TAU * turns);
            }
        }
        let found = Spectrum::new(plane.view(), Window::None).bin(k as isize, l as isize);
        prop_assert!((found - sum).norm() < 1e-10);
    }
}

#[test]
fn a_sinusoid_is_two_points_about_the_middle() {
    for (w, h) in [(32, 24), (33, 25), (31, 24)] {
        let wave = Image::from_fn(w, h, |x, y| {
            0.25 + (TAU * (3.0 * x as f64 / w as f64 - 2.0 * y as f64 / h as f64)).cos()
        });
        let amplitudes = Spectrum::new(wave.unwrap().view(), Window::None).amplitudes();
        let (cx, cy) = (w / 2, h / 2);
        for y in 0..h {
            for x in 0..w {
                let at = (x as isize - cx as isize, y as isize - cy as isize);
                let expected = match at {
                    (0, 0) => 0.25,
                    (3, -2) | (-3, 2) => 0.5,
                    _ => 0.0,
                };
                assert!((amplitudes.row(y)[x] - expected).abs() < 1e-14, "{at:?}");
            }
        }
    }
}

#[test]
fn a_gaussian_has_a_gaussian_spectrum() {
    // exp(−r²/2s²) has the transform 2πs²·exp(−2π²s²f²).
    let (n, s) = (64, 3.0);
    let centre = (n / 2) as f64;
    let plane = Image::from_fn(n, n, |x, y| {
        let (dx, dy) = (x as f64 - centre, y as f64 - centre);
        (-(dx * dx + dy * dy) / (2.0 * s * s)).exp()
    });
    let spectrum = Spectrum::new(plane.unwrap().view(), Window::None);
    for (f, bin) in spectrum.bins() {
        let r2 = f.x * f.x + f.y * f.y;
        let expected = TAU * s * s * (-2.0 * PI * PI * s * s * r2).exp();
        assert!((bin.norm() - expected).abs() < 1e-4, "{f:?}");
    }
}

#[test]
fn a_box_has_the_spectrum_of_a_periodic_sinc() {
    // Nine ones among n: sin(9πk/n) / sin(πk/n), which is sinc where k is small beside n.
    let n = 4096_usize;
    let plane = Image::from_fn(n, 1, |x, _| f64::from(u8::from(x < 9))).unwrap();
    let spectrum = Spectrum::new(plane.view(), Window::None);
    for k in 1..n / 2 {
        let t = PI * k as f64 / n as f64;
        let expected = ((9.0 * t).sin() / t.sin()).abs();
        assert!((spectrum.bin(k as isize, 0).norm() - expected).abs() < 1e-10);
    }
    for k in 1..64 {
        let t = 9.0 * PI * f64::from(k) / n as f64;
        let sinc = 9.0 * t.sin() / t;
        assert!(
            (spectrum.bin(k as isize, 0).norm() - sinc.abs()).abs() < 1e-2 * sinc.abs().max(0.1)
        );
    }
}

#[test]
fn decibels_are_a_scale() {
    let n = 16;
    let wave = |a: f64| move |x: usize, _: usize| 1.0 + 2.0 * a * (TAU * x as f64 / 8.0).cos();
    let plane = Image::from_fn(n, n, wave(0.01)).unwrap();
    let spectrum = Spectrum::new(plane.view(), Window::None);
    assert!((spectrum.peak() - 1.0).abs() < 1e-14);
    // 0.01 is −40 dB: half way on a scale of 80, at its end on one of 40.
    let at = |range: f64| spectrum.decibels(1.0, range).row(8)[10];
    assert!((at(80.0) - 0.5).abs() < 1e-9);
    assert!(at(40.0) < 1e-9);
    assert!((spectrum.decibels(1.0, 80.0).row(8)[8] - 1.0).abs() < 1e-12);
    assert_eq!(spectrum.decibels(1.0, 80.0).row(3)[3], 0.0);
    for odd in [spectrum.decibels(0.0, 80.0), spectrum.decibels(f64::NAN, 0.0)] {
        assert!(odd.pixels().iter().all(|v| (0.0..=1.0).contains(v)));
    }
}

#[test]
fn a_window_takes_the_cross_away() {
    let ramp = Image::from_fn(64, 64, |x, _| x as f64).unwrap();
    let share = |window| {
        let spectrum = Spectrum::new(ramp.view(), window);
        spectrum.energy(|f| f.x.abs() > 0.1) / spectrum.energy(|_| true)
    };
    assert!(share(Window::Hann) < 1e-3 * share(Window::None));
}

#[test]
fn without_pixels_there_are_no_bins() {
    for (w, h) in [(0, 0), (0, 4), (4, 0)] {
        let nothing = Image::filled(w, h, 1.0).unwrap();
        let spectrum = Spectrum::new(nothing.view(), Window::Hann);
        assert_eq!(spectrum.bin(1, 1).norm(), 0.0);
        assert_eq!(spectrum.bins().count(), 0);
        assert_eq!(spectrum.inverse().pixels().len(), 0);
        assert_eq!((spectrum.energy(|_| true), spectrum.peak()), (0.0, 0.0));
        assert!(spectrum.decibels(1.0, 60.0).pixels().is_empty());
    }
}
