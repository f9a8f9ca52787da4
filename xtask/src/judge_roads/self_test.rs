//! Whether the judges of roads are worth asking: good files must pass, and each damage must be seen by those judges that are there for it.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};

use super::verdict::Verdict;
use super::{Case, Judge, Times, judges_of};
use crate::steps::Outcome;
use crate::tree;

/// A file of the shared data folder of which it is known that some judges refuse it, and why: a refusal that ends is told as well.
struct Refused {
    file: &'static str,
    by: &'static [&'static str],
}

/// Road 229 has no links back from the lanes 4 and -4 that road 284 links to it, nor their width; and its signals have values without a unit.
const REFUSED: [Refused; 1] = [Refused { file: "xodr/multi_intersections.xodr", by: &["plan", "asam", "maliput"] }];

/// A way to damage a good file, and who must see it.
struct Damage {
    what: &'static str,
    /// The end of its path; with a folder in it, it is one of the shared files.
    file: &'static str,
    seen_by: &'static [&'static str],
    /// The damaged file; none where it has not what is to be damaged.
    make: fn(&str) -> Option<String>,
}

impl Damage {
    /// Writes the damaged file into a folder of its own, since its name may tell a judge what it is.
    fn done_to(&self, good: &Path, folder: &Path) -> Result<PathBuf> {
        let bytes = fs::read(good).with_context(|| format!("cannot read {}", good.display()))?;
        // Latin-1 keeps every byte of what is no text.
        let text: String = bytes.iter().map(|&byte| char::from(byte)).collect();
        let damaged = (self.make)(&text).filter(|damaged| *damaged != text);
        let damaged = damaged.with_context(|| format!("{} has nothing for the damage: {}", self.file, self.what))?;
        let bytes = damaged.chars().map(|letter| u8::try_from(u32::from(letter))).collect::<Result<Vec<u8>, _>>()?;
        let name = good.file_name().context("a good file has a name")?.to_string_lossy();
        fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
        let file = folder.join(format!("damaged-{name}"));
        fs::write(&file, bytes).with_context(|| format!("cannot write {}", file.display()))?;
        Ok(file)
    }
}

const EVERY_READER: &[&str] = &["plan", "asam", "maliput", "sumo", "carla"];

const DAMAGES: [Damage; 22] = [
    Damage { what: "cut off", file: "junction.xodr", seen_by: EVERY_READER, make: cut },
    Damage {
        what: "a geometry moved by 1 m",
        file: "junction.xodr",
        seen_by: &["plan", "asam", "maliput"],
        make: |text| moved(text, "<geometry s=\"50\" ", "x", 1.0),
    },
    Damage {
        what: "a geometry moved by 2 cm",
        file: "junction.xodr",
        seen_by: &["plan", "asam"],
        make: |text| moved(text, "<geometry s=\"50\" ", "x", 0.02),
    },
    Damage {
        what: "a geometry moved by 5 mm",
        file: "junction.xodr",
        seen_by: &["plan"],
        make: |text| moved(text, "<geometry s=\"50\" ", "x", 0.005),
    },
    Damage {
        what: "a spiral of another curvature",
        file: "junction.xodr",
        seen_by: &["plan", "asam", "maliput"],
        make: |text| moved(text, "<spiral ", "curvEnd", 0.01),
    },
    Damage {
        what: "a connecting road 1 m lower",
        file: "junction.xodr",
        seen_by: &["plan", "maliput"],
        make: |text| {
            moved(from(text, "id=\"10\" ")?, "<elevation s=\"0\" ", "a", -1.0)
                .map(|rest| before(text, "id=\"10\" ") + &rest)
        },
    },
    Damage {
        what: "a break of slope",
        file: "junction.xodr",
        seen_by: &["maliput"],
        make: |text| moved(text, "<elevation s=\"100\" ", "b", 0.1),
    },
    Damage {
        what: "a connecting road with a narrower lane",
        file: "junction.xodr",
        seen_by: &["plan", "asam", "maliput"],
        make: |text| {
            moved(from(text, "id=\"10\" ")?, "<width ", "a", -0.5).map(|rest| before(text, "id=\"10\" ") + &rest)
        },
    },
    Damage {
        what: "a link to a road that is not there",
        file: "junction.xodr",
        seen_by: &["plan", "asam", "maliput", "sumo"],
        make: |text| {
            exchanged(
                text,
                "<predecessor elementType=\"road\" elementId=\"1\"",
                "<predecessor elementType=\"road\" elementId=\"77\"",
            )
        },
    },
    Damage {
        what: "a geometry moved by 1 m",
        file: "xodr/curves.xodr",
        seen_by: &["plan", "maliput"],
        make: |text| moved(text, "<geometry ", "x", 1.0),
    },
    Damage { what: "cut off", file: "spirals.xml", seen_by: &["alignments", "xmllint"], make: cut },
    Damage {
        what: "a spiral with a wrong end",
        file: "spirals.xml",
        seen_by: &["alignments"],
        make: |text| moved(text, "<Spiral ", "radiusEnd", 0.5),
    },
    Damage {
        what: "a curve that turns to nowhere",
        file: "spirals.xml",
        seen_by: &["alignments", "xmllint"],
        make: |text| exchanged(text, "<Curve rot=\"ccw\"", "<Curve"),
    },
    Damage {
        what: "two points of a surface with one id",
        file: "spirals.xml",
        seen_by: &["alignments"],
        make: |text| exchanged(text, "<P id=\"2\"", "<P id=\"1\""),
    },
    Damage {
        what: "a triangle with a corner that is not there",
        file: "spirals.xml",
        seen_by: &["alignments"],
        make: |text| exchanged(text, "<F>1 2 3", "<F>1 2 4"),
    },
    Damage {
        what: "two surfaces of one name",
        file: "spirals.xml",
        seen_by: &["xmllint"],
        make: |text| {
            let from = text.find("<Surface ")?;
            let to = text.find("</Surfaces>")?;
            Some(text.replacen("</Surfaces>", &format!("{}</Surfaces>", &text[from..to]), 1))
        },
    },
    Damage {
        what: "an arc of another radius",
        file: "landxml/M3_RS-CL.tg.xml",
        seen_by: &["alignments"],
        make: |text| moved(text, "<Curve ", "radius", 0.5),
    },
    Damage { what: "cut off", file: "osm/monaco_roads.geojson", seen_by: &["check-geojson", "ogrinfo"], make: cut },
    Damage { what: "cut off", file: "tokyo.geojson", seen_by: &["check-geojson", "ogrinfo"], make: cut },
    Damage {
        what: "a line of one point",
        file: "tokyo.geojson",
        seen_by: &["check-geojson"],
        make: |text| exchanged(text, ",[139.701,35.651]", ""),
    },
    Damage {
        what: "latitude before longitude",
        file: "tokyo.geojson",
        seen_by: &["ogrinfo"],
        make: |text| exchanged(&exchanged(text, "139.7,35.65", "35.65,139.7")?, "139.701,35.651", "35.651,139.701"),
    },
    Damage {
        what: "a scene that is not there",
        file: "empty.glb",
        seen_by: &["gltf"],
        make: |text| exchanged(text, "\"scene\":0", "\"scene\":7"),
    },
];

/// Far enough from Greenwich that exchanged coordinates lie nowhere.
const TOKYO: &str = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":"road"},
"geometry":{"type":"LineString","coordinates":[[139.7,35.65],[139.701,35.651]]}}]}"#;

/// Judges the good files and the damaged ones.
pub(super) fn run() -> Result<Outcome> {
    let scratch = tree::scratch("judge-roads")?;
    let mut times = Times::default();
    let mut complaints = Vec::new();
    let mut own = Vec::new();
    for name in ["junction.xodr", "spirals.xml"] {
        own.push(tree::root().join("xtask/judges/roads").join(name));
    }
    for (name, bytes) in [("tokyo.geojson", TOKYO.as_bytes().to_vec()), ("empty.glb", empty_glb())] {
        let file = scratch.join(name);
        fs::write(&file, bytes).with_context(|| format!("cannot write {}", file.display()))?;
        own.push(file);
    }
    let shared = shared_files()?;
    let mut cases = Vec::new();
    for file in own.iter().chain(&shared) {
        cases.extend(judges_of(file)?.into_iter().map(|judge| Case { judge, file }));
    }
    for (case, verdict) in times.ask(&cases)? {
        complaints.extend(complaint_on_good(case.judge, case.file, &verdict?));
    }
    let mut damaged = Vec::new();
    for damage in &DAMAGES {
        match own.iter().chain(&shared).find(|file| file.ends_with(damage.file)) {
            Some(good) => damaged.push((damage, damage.done_to(good, &scratch.join(damaged.len().to_string()))?)),
            None if shared.is_empty() && damage.file.contains('/') => println!("skipped: damage of {}", damage.file),
            None => bail!("there is no {} to damage", damage.file),
        }
    }
    let (mut cases, mut damages_of) = (Vec::new(), Vec::new());
    for (damage, file) in &damaged {
        let mut judges = judges_of(file)?;
        judges.retain(|judge| damage.seen_by.contains(&judge.name));
        ensure!(judges.len() == damage.seen_by.len(), "not every judge of {:?} reads {}", damage.seen_by, damage.file);
        damages_of.extend(judges.iter().map(|_| *damage));
        cases.extend(judges.into_iter().map(|judge| Case { judge, file }));
    }
    for (damage, (Case { judge, .. }, verdict)) in damages_of.iter().zip(times.ask(&cases)?) {
        match verdict?.faults.first() {
            Some(fault) => println!("damaged {}, {}: {} sees it: {fault}", damage.file, damage.what, judge.name),
            None => complaints.push(format!("{} does not see in {}: {}", judge.name, damage.file, damage.what)),
        }
    }
    times.show();
    if !complaints.is_empty() {
        bail!("{}", complaints.join("\n"));
    }
    let (good, damages) = (own.len() + shared.len(), DAMAGES.len());
    Ok(Outcome::Passed(format!(
        "{} verdicts: {good} files as they should be judged, {damages} damages seen",
        times.asked()
    )))
}

/// What is wrong with a judge's word on a good file.
fn complaint_on_good(judge: &Judge, file: &Path, verdict: &Verdict) -> Option<String> {
    super::show(judge, file, verdict);
    let known = REFUSED.iter().any(|refused| file.ends_with(refused.file) && refused.by.contains(&judge.name));
    match (known, verdict.faults.is_empty()) {
        (false, false) => Some(format!("{} refuses {}, which is good", judge.name, file.display())),
        (true, true) => Some(format!("{} no longer refuses {}: say so in the self-test", judge.name, file.display())),
        _ => None,
    }
}

/// The files of roads in the shared data folder, which must be there on the build server.
fn shared_files() -> Result<Vec<PathBuf>> {
    let root = tree::shared().join("data/roads");
    if !root.is_dir() && !tree::on_build_server() {
        println!("skipped: no shared files at {}", root.display());
        return Ok(Vec::new());
    }
    let mut files = Vec::new();
    for (folder, extension) in [("xodr", "xodr"), ("landxml", "xml"), ("osm", "geojson")] {
        let entries = fs::read_dir(root.join(folder)).with_context(|| format!("no {folder} in {}", root.display()))?;
        for entry in entries {
            let path = entry?.path();
            if path.extension().is_some_and(|found| found == extension) {
                files.push(path);
            }
        }
    }
    files.sort();
    ensure!(
        REFUSED.iter().all(|refused| files.iter().any(|file| file.ends_with(refused.file))),
        "a known file is missing"
    );
    Ok(files)
}

/// glTF with an empty scene in it, packed: a header, and one chunk of JSON filled up to a multiple of four bytes.
fn empty_glb() -> Vec<u8> {
    let mut json = br#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{}]}"#.to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let chunk = u32::try_from(json.len()).expect("it is short");
    let head = [*b"glTF", 2_u32.to_le_bytes(), (12 + 8 + chunk).to_le_bytes(), chunk.to_le_bytes(), *b"JSON"];
    [head.concat(), json].concat()
}

/// The first half.
fn cut(text: &str) -> Option<String> {
    let middle = text.chars().count() / 2;
    Some(text.chars().take(middle).collect())
}

/// The text from a mark on.
fn from<'a>(text: &'a str, mark: &str) -> Option<&'a str> {
    text.find(mark).map(|at| &text[at..])
}

/// The text before a mark.
fn before(text: &str, mark: &str) -> String {
    text.find(mark).map_or(text, |at| &text[..at]).to_owned()
}

/// The first occurrence of something exchanged.
fn exchanged(text: &str, old: &str, new: &str) -> Option<String> {
    text.contains(old).then(|| text.replacen(old, new, 1))
}

/// The first number of this name after a mark, changed by so much.
fn moved(text: &str, mark: &str, name: &str, by: f64) -> Option<String> {
    let start = text.find(mark)?;
    let key = format!("{name}=\"");
    let begin = start + text[start..].find(&key)? + key.len();
    let end = begin + text[begin..].find('"')?;
    let number: f64 = text[begin..end].parse().ok()?;
    number.is_finite().then(|| format!("{}{}{}", &text[..begin], number + by, &text[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_moved_after_its_mark_only() {
        let text = r#"<a x="1"/><b x="2" y="3"/>"#;
        assert_eq!(moved(text, "<b ", "x", 0.5).unwrap(), r#"<a x="1"/><b x="2.5" y="3"/>"#);
        assert_eq!(moved(text, "<c ", "x", 0.5), None);
        assert_eq!(moved(r#"<a x="INF"/>"#, "<a ", "x", 1.0), None);
    }

    #[test]
    fn every_damage_names_judges_that_read_its_file() {
        for damage in &DAMAGES {
            let judges = judges_of(Path::new(damage.file)).unwrap();
            for name in damage.seen_by {
                assert!(judges.iter().any(|judge| judge.name == *name), "{name} and {}", damage.file);
            }
        }
        // And no judge is trusted untried.
        for judge in &super::super::JUDGES {
            assert!(DAMAGES.iter().any(|damage| damage.seen_by.contains(&judge.name)), "{} is untried", judge.name);
        }
    }

    #[test]
    fn a_packed_file_tells_its_length() {
        let bytes = empty_glb();
        assert_eq!(bytes.len() % 4, 0);
        assert_eq!(bytes[8..12], u32::try_from(bytes.len()).unwrap().to_le_bytes());
    }
}
