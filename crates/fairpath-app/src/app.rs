//! A stand-in for the application: strokes in, curves out.
use std::cell::RefCell;
use std::rc::Rc;

use eframe::egui;
use fairpath_curve::Point;
use fairpath_fit::Stroke;
use fairpath_io::{ReadOptions, SplineFile, SplineFormat, StrokeFile, StrokeFormat, WriteOptions};

use crate::pen::{PenPhase, PenSample};

#[derive(Default)]
struct Curves {
    file: SplineFile,
    deaths: Vec<String>,
}

/// The application.
pub struct App {
    strokes: Vec<Stroke>,
    drawing: Vec<PenSample>,
    curves: Rc<RefCell<Curves>>,
    #[cfg(target_arch = "wasm32")]
    worker: crate::web::JobWorker,
}

impl App {
    /// A fresh one.
    #[must_use]
    pub fn new(creation: &eframe::CreationContext<'_>) -> Self {
        let curves = Rc::new(RefCell::new(Curves::default()));
        let _ = creation;
        #[cfg(target_arch = "wasm32")]
        let worker = {
            let curves = Rc::clone(&curves);
            crate::web::JobWorker::new(&creation.egui_ctx, move |_, outcome| match outcome {
                Ok(answer) => curves.borrow_mut().take(&answer),
                Err(reason) => curves.borrow_mut().deaths.push(reason),
            })
        };
        Self {
            strokes: Vec::new(),
            drawing: Vec::new(),
            curves,
            #[cfg(target_arch = "wasm32")]
            worker,
        }
    }

    /// Figures.
    #[must_use]
    pub fn state_json(&self) -> String {
        let curves = self.curves.borrow();
        let segments: usize = curves.file.splines.iter().map(|entry| entry.spline.segments().len()).sum();
        serde_json::json!({ "strokes": self.strokes.len(), "curves": curves.file.splines.len(), "segments": segments,
            "busy": self.strokes.len() > curves.file.splines.len() + curves.deaths.len(), "troubles": curves.deaths })
        .to_string()
    }

    /// Strokes.
    #[must_use]
    pub fn strokes_json(&self) -> String {
        encoded_strokes(&self.strokes)
    }

    /// The drawing.
    #[must_use]
    pub fn svg(&self) -> String {
        let file = &self.curves.borrow().file;
        let encoded = fairpath_io::encode_splines(file, SplineFormat::Svg, None, &WriteOptions::default());
        encoded.map(|encoded| String::from_utf8_lossy(&encoded.bytes).into_owned()).unwrap_or_default()
    }

    fn take(&mut self, sample: PenSample) {
        match sample.phase {
            PenPhase::Down => self.drawing = vec![sample],
            PenPhase::Move => self.drawing.push(sample),
            PenPhase::Cancel => self.drawing.clear(),
            PenPhase::Up => {
                let drawn = std::mem::take(&mut self.drawing);
                let mut stroke = Stroke::new(
                    format!("stroke {}", self.strokes.len() + 1),
                    drawn.iter().map(|sample| Point::new(sample.x, sample.y)).collect(),
                );
                stroke.times_s = drawn.iter().map(|sample| sample.time_s).collect();
                #[cfg(target_arch = "wasm32")]
                self.worker.send(self.strokes.len() as u64, encoded_strokes(std::slice::from_ref(&stroke)));
                #[cfg(not(target_arch = "wasm32"))]
                self.curves
                    .borrow_mut()
                    .take(&crate::job::run_encoded_job(&encoded_strokes(std::slice::from_ref(&stroke))));
                self.strokes.push(stroke);
            }
        }
    }
}

impl Curves {
    fn take(&mut self, answer: &str) {
        let read = fairpath_io::read_splines_from(
            answer.as_bytes(),
            "answer",
            Some(SplineFormat::Json),
            &ReadOptions::default(),
        );
        if let Ok(file) = read {
            self.file.splines.extend(file.splines);
        }
    }
}

fn encoded_strokes(strokes: &[Stroke]) -> String {
    let bytes = fairpath_io::encode_strokes(&StrokeFile::new(strokes.to_vec()), StrokeFormat::Json);
    bytes.map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default()
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        #[cfg(target_arch = "wasm32")]
        for sample in crate::web::pen::drain() {
            self.take(sample);
        }
        if ui.input(|input| input.key_pressed(egui::Key::P)) {
            panic!("asked to panic");
        }
        egui::CentralPanel::default().show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label(format!("{} strokes", self.strokes.len()));
                #[cfg(target_arch = "wasm32")]
                if ui.button("Save SVG").clicked() {
                    let _ = crate::web::download("drawing.svg", self.svg().as_bytes(), "image/svg+xml");
                }
                #[cfg(target_arch = "wasm32")]
                if ui.button("Die").clicked() {
                    self.worker.send(1000, "die of this".into());
                }
            });
            let pos = |p: Point| egui::pos2(p.x as f32, p.y as f32);
            let painter = ui.painter();
            let thin = egui::Stroke::new(1.0, egui::Color32::GRAY);
            for stroke in &self.strokes {
                painter.line(stroke.points.iter().map(|p| pos(*p)).collect(), thin);
            }
            painter.line(self.drawing.iter().map(|s| pos(Point::new(s.x, s.y))).collect(), thin);
            for entry in &self.curves.borrow().file.splines {
                for segment in entry.spline.segments() {
                    let points =
                        (0..=32).map(|i| pos(segment.point_at(segment.length * f64::from(i) / 32.0))).collect();
                    painter.line(points, egui::Stroke::new(2.5, egui::Color32::from_rgb(40, 110, 220)));
                }
            }
        });
    }

    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(&mut *self)
    }
}
