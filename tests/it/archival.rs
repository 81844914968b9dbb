//! PDF/A, judged by others: the main points of part 3 (ISO 19005-3) as `qpdf` tells the file, and Apache PDFBox Preflight, a checker
//! of part 1 (Debian: `libpdfbox2-java`). No veraPDF can be had where this is built, so no file is certified for part 3.
#![cfg_attr(not(feature = "pdf"), allow(dead_code, reason = "the PDF is behind a feature"))]

use std::collections::BTreeSet;
use std::io::Write;
use std::path::Path;
use std::process::Command;

use base64::Engine;
use serde_json::{Map, Value};

type Dict = Map<String, Value>;

/// A file as `qpdf --json` tells it.
struct Pdf {
    value: Value,
}

impl Pdf {
    /// `None` where this machine has no qpdf.
    fn read(bytes: &[u8]) -> Option<Self> {
        let mut file = tempfile::NamedTempFile::new().expect("a file");
        file.write_all(bytes).expect("written");
        let mut command = Command::new("qpdf");
        command.args(["--json=2", "--json-stream-data=inline", "--decode-level=none"]).arg(file.path());
        let Ok(output) = command.output() else {
            println!("skipped: `qpdf` is not here");
            return None;
        };
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        Some(Self { value: serde_json::from_slice(&output.stdout).expect("JSON") })
    }

    fn objects(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.value["qpdf"][1].as_object().into_iter().flatten().map(|(key, object)| (key.as_str(), object))
    }

    /// The value that `value` is, or refers to.
    fn at<'a>(&'a self, value: &'a Value) -> &'a Value {
        let Some(reference) = value.as_str().filter(|text| text.ends_with(" R")) else { return value };
        let object = &self.value["qpdf"][1][format!("obj:{reference}")];
        if object["stream"].is_object() { &object["stream"]["dict"] } else { &object["value"] }
    }

    fn trailer(&self) -> &Value {
        &self.value["qpdf"][1]["trailer"]["value"]
    }

    /// The bytes of a stream, as they are in the file.
    fn data(&self, reference: &Value) -> Vec<u8> {
        let object = &self.value["qpdf"][1][format!("obj:{}", reference.as_str().unwrap_or_default())];
        let data = object["stream"]["data"].as_str().unwrap_or_default();
        base64::engine::general_purpose::STANDARD.decode(data).unwrap_or_default()
    }

    /// Every dictionary of the file, those inside of others, too.
    fn dicts(&self) -> Vec<&Dict> {
        let mut open: Vec<&Value> = self.objects().map(|(_, object)| object).collect();
        let mut dicts = Vec::new();
        while let Some(value) = open.pop() {
            match value {
                Value::Object(map) => {
                    dicts.push(map);
                    open.extend(map.values());
                }
                Value::Array(list) => open.extend(list),
                _ => {}
            }
        }
        dicts
    }
}

/// What in `bytes` is against PDF/A-3, in order; `None` where this machine cannot tell.
pub(crate) fn faults(bytes: &[u8]) -> Option<Vec<String>> {
    let pdf = Pdf::read(bytes)?;
    let mut out = BTreeSet::new();
    let mut ask = |holds: bool, what: &str| {
        if !holds {
            out.insert(what.to_owned());
        }
    };
    ask(bytes.starts_with(b"%PDF-1."), "6.1.2 the header is not that of PDF 1");
    ask(pdf.trailer()["/ID"].as_array().is_some_and(|id| id.len() == 2), "6.1.3 the file has no identifier");
    ask(pdf.trailer()["/Encrypt"].is_null(), "6.1.3 the file is encrypted");
    let catalog = pdf.at(&pdf.trailer()["/Root"]);
    intents(&pdf, catalog, &mut ask);
    metadata(&pdf, catalog, &mut ask);
    for dict in pdf.dicts() {
        fonts(&pdf, dict, &mut ask);
        attachments(&pdf, catalog, dict, &mut ask);
        forbidden(dict, &mut ask);
    }
    Some(out.into_iter().collect())
}

/// The jars of Preflight and of what it needs.
const JARS: [&str; 7] =
    ["preflight", "pdfbox2", "fontbox2", "xmpbox", "commons-logging", "javax.activation", "jaxb-api"];

/// Codes of Preflight, or how its lines begin, for what PDF/A-1 forbids and later parts allow: colour profiles of version 4,
/// attached files, another part in the metadata. It gives up after 10,000 lines, for which the profiles are enough.
const LATER: [&str; 5] = [
    "2.1.6 : Invalid graphics object, Invalid version of the ICCProfile",
    "1.2.9 : Body Syntax error, EmbeddedFile entry is present in a FileSpecification",
    "1.4.7 : Trailer Syntax error, EmbeddedFile entry is present in the Names",
    "7.11.2 : Error on MetaData, part must be 1",
    "-1 : Unknown error, Over 10000 errors",
];
/// What version 2.0.27 says of files that are in order: it does not follow references to destinations, which PDF allows
/// everywhere (ISO 32000-1, 7.3.10), and does not read the extension schema by which PDF/UA is declared in the metadata.
const MISTAKEN: [&str; 2] = [
    "1.2.3 : Body Syntax error, Error: can't convert to Destination COSObject",
    "7.3 : Error on MetaData, Cannot find a definition for the namespace http://www.aiim.org/pdfua/ns/id/",
];

/// What Preflight finds against PDF/A-1b; without `is_first`, not what parts 2 and 3 allow. `None` where it is not here.
pub(crate) fn preflight(bytes: &[u8], is_first: bool) -> Option<Vec<String>> {
    let jars = JARS.map(|name| format!("/usr/share/java/{name}.jar"));
    let mut file = tempfile::Builder::new().suffix(".pdf").tempfile().expect("a file");
    file.write_all(bytes).expect("written");
    let mut command = Command::new("java");
    command.args(["-cp", &jars.join(":"), "org.apache.pdfbox.preflight.Validator_A1b"]).arg(file.path());
    let output = jars.iter().all(|jar| Path::new(jar).exists()).then(|| command.output().ok()).flatten();
    let Some(output) = output else {
        println!("skipped: PDFBox Preflight is not here");
        return None;
    };
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.starts_with("The file "), "{said}{}", String::from_utf8_lossy(&output.stderr));
    let known = if is_first { &[][..] } else { &LATER[..] };
    let is_known = |line: &&str| known.iter().chain(&MISTAKEN).any(|begin| line.starts_with(begin));
    Some(said.lines().skip(1).filter(|line| !line.is_empty() && !is_known(line)).map(str::to_owned).collect())
}

/// How many files are attached; `None` where this machine cannot tell.
pub(crate) fn attached(bytes: &[u8]) -> Option<usize> {
    Some(Pdf::read(bytes)?.dicts().iter().filter(|dict| dict.contains_key("/EF")).count())
}

type Ask<'a> = dyn FnMut(bool, &str) + 'a;

fn intents(pdf: &Pdf, catalog: &Value, ask: &mut Ask<'_>) {
    let list = pdf.at(&catalog["/OutputIntents"]).as_array();
    let archival = list.into_iter().flatten().map(|one| pdf.at(one)).find(|one| one["/S"] == "/GTS_PDFA1");
    let profile = archival.map(|intent| pdf.at(&intent["/DestOutputProfile"]));
    ask(profile.is_some_and(|profile| profile["/N"].is_number()), "6.2.3 no output intent with a colour profile");
}

fn metadata(pdf: &Pdf, catalog: &Value, ask: &mut Ask<'_>) {
    let reference = &catalog["/Metadata"];
    ask(pdf.at(reference)["/Filter"].is_null(), "6.6.2 the metadata is compressed");
    let text = String::from_utf8_lossy(&pdf.data(reference)).into_owned();
    let xmp = roxmltree::Document::parse(text.trim_matches(|c: char| c != '<' && c != '>')).ok();
    let told = |name: &str| {
        let id = "http://www.aiim.org/pdfa/ns/id/";
        let nodes = xmp.iter().flat_map(roxmltree::Document::descendants);
        let mut found = nodes.filter_map(|node| {
            let text = node.has_tag_name((id, name)).then(|| node.text()).flatten();
            text.or_else(|| node.attribute((id, name))).map(str::to_owned)
        });
        found.next().unwrap_or_default()
    };
    ask(told("part") == "3", "6.6.4 the metadata does not say part 3");
    ask(["A", "B", "U"].contains(&told("conformance").as_str()), "6.6.4 the metadata says no level of conformance");
}

/// A font is in the file; one of type 3 is drawn by it, one of type 0 by its descendants.
fn fonts(pdf: &Pdf, dict: &Dict, ask: &mut Ask<'_>) {
    let subtype = dict.get("/Subtype").and_then(Value::as_str).unwrap_or_default();
    if dict.get("/Type").is_some_and(|kind| kind == "/Font") && !["/Type0", "/Type3"].contains(&subtype) {
        let descriptor = dict.get("/FontDescriptor").map_or(&Value::Null, |value| pdf.at(value));
        let embedded = ["/FontFile", "/FontFile2", "/FontFile3"].iter().any(|key| !descriptor[*key].is_null());
        ask(embedded, "6.2.11.4 a font is not embedded");
    }
}

fn attachments(pdf: &Pdf, catalog: &Value, dict: &Dict, ask: &mut Ask<'_>) {
    let Some(file) = dict.get("/EF").map(|files| pdf.at(files)) else { return };
    let has = |key: &str| dict.get(key).is_some_and(Value::is_string);
    ask(has("/F") && has("/UF"), "6.8 an attachment has not both names");
    ask(has("/AFRelationship"), "6.8 an attachment does not say how it belongs to the document");
    ask(has("/Desc"), "6.8 an attachment has no description");
    let stream = pdf.at(&file["/F"]);
    ask(stream["/Subtype"].is_string(), "6.8 an attachment has no media type");
    let named = pdf.at(&catalog["/AF"]).as_array().into_iter().flatten();
    let listed = named.map(|one| pdf.at(one)).any(|one| one.as_object() == Some(dict));
    ask(listed, "6.8 an attachment is not associated with the document");
}

fn forbidden(dict: &Dict, ask: &mut Ask<'_>) {
    let action = dict.get("/S").and_then(Value::as_str).unwrap_or_default();
    let never = ["/Launch", "/Sound", "/Movie", "/ResetForm", "/ImportData", "/JavaScript"];
    ask(!never.contains(&action), "6.5.1 an action that is forbidden");
    ask(!dict.contains_key("/AA"), "6.5.2 an additional action");
    ask(!dict.get("/Filter").is_some_and(|filter| filter.to_string().contains("LZW")), "6.1.7 LZW");
    if dict.get("/Type").is_some_and(|kind| kind == "/Annot") && dict.get("/Subtype").is_some_and(|s| s != "/Popup") {
        // Print is set; hidden, invisible and not to be viewed are not.
        let flags = dict.get("/F").and_then(Value::as_u64).unwrap_or(0);
        ask(flags & 0b10_0111 == 0b100, "6.3.2 an annotation is not printed");
    }
}

/// A small file with an attachment that keeps every point; `%` begins no comment in it.
const SMALL: [&str; 11] = [
    "<< /Type /Catalog /Pages 2 0 R /OutputIntents [5 0 R] /Metadata 7 0 R /AF [8 0 R] >>",
    "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
    "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 9 9] /Resources << /Font << /A 4 0 R >> >> /Annots [11 0 R] >>",
    "<< /Type /Font /Subtype /TrueType /BaseFont /A /FontDescriptor 10 0 R >>",
    "<< /Type /OutputIntent /S /GTS_PDFA1 /OutputConditionIdentifier (x) /DestOutputProfile 6 0 R >>",
    "<< /N 3 /Length 1 >>\nstream\nx\nendstream",
    "<< /Type /Metadata /Subtype /XML /Length 175 >>\nstream\n<x xmlns:p=\"http://www.aiim.org/pdfa/ns/id/\"><p:part>3</p:part><p:conformance>B</p:conformance></x>\nendstream",
    "<< /Type /Filespec /F (a) /UF (a) /Desc (a) /AFRelationship /Data /EF << /F 9 0 R /UF 9 0 R >> >>",
    "<< /Type /EmbeddedFile /Subtype /text#2fplain /Length 1 >>\nstream\nx\nendstream",
    "<< /Type /FontDescriptor /FontName /A /FontFile2 6 0 R >>",
    "<< /Type /Annot /Subtype /Link /Rect [0 0 1 1] /F 4 >>",
];

/// The file of `objects`, with the lengths of its streams set right.
fn file(objects: &[String], trailer: &str) -> Vec<u8> {
    let mut out = "%PDF-1.7\n".to_owned();
    let mut places = Vec::new();
    for (number, object) in objects.iter().enumerate() {
        places.push(out.len());
        let length = object.split("stream\n").nth(1).map_or(0, |rest| rest.len() - "\nendstream".len());
        let object = object.replace("/Length 175", &format!("/Length {length}"));
        out.push_str(&format!("{} 0 obj\n{object}\nendobj\n", number + 1));
    }
    let start = out.len();
    out.push_str(&format!("xref\n0 {}\n0000000000 65535 f \n", objects.len() + 1));
    places.iter().for_each(|place| out.push_str(&format!("{place:010} 00000 n \n")));
    let size = objects.len() + 1;
    out.push_str(&format!("trailer\n<< /Size {size} /Root 1 0 R {trailer} >>\nstartxref\n{start}\n%%EOF\n"));
    out.into_bytes()
}

#[test]
fn each_point_is_missed_where_it_is_missing() {
    let id = "/ID [<00> <00>]";
    let small: Vec<String> = SMALL.map(str::to_owned).into();
    let Some(none) = faults(&file(&small, id)) else { return };
    assert_eq!(none, Vec::<String>::new());
    for (from, to, part) in [
        (" /OutputIntents [5 0 R]", "", "6.2.3"),
        ("/GTS_PDFA1", "/GTS_PDFX", "6.2.3"),
        ("<p:part>3", "<p:part>2", "part 3"),
        ("<p:conformance>B", "<p:conformance>X", "level of conformance"),
        (" /FontFile2 6 0 R", "", "not embedded"),
        (" /AFRelationship /Data", "", "belongs"),
        (" /Desc (a)", "", "description"),
        ("/F (a) /UF (a)", "/F (a)", "both names"),
        (" /Subtype /text#2fplain", "", "media type"),
        (" /AF [8 0 R]", "", "associated"),
        ("/F 4 >>", "/F 2 >>", "6.3.2"),
        ("/Rect [0 0 1 1]", "/Rect [0 0 1 1] /A << /S /JavaScript /JS (x) >>", "6.5.1"),
        ("/Rect [0 0 1 1]", "/Rect [0 0 1 1] /AA << >>", "6.5.2"),
    ] {
        let changed: Vec<String> = small.iter().map(|object| object.replace(from, to)).collect();
        assert_ne!(changed, small, "{from}");
        let found = faults(&file(&changed, id)).unwrap_or_default();
        assert!(found.len() == 1 && found[0].contains(part), "without {from}: {found:?}");
    }
    assert_eq!(faults(&file(&small, "")).unwrap_or_default(), ["6.1.3 the file has no identifier"]);
}

#[test]
fn preflight_sees_what_is_wrong() {
    let small: Vec<String> = SMALL.map(str::to_owned).into();
    let Some(found) = preflight(&file(&small, ""), false) else { return };
    assert!(found.iter().any(|line| line.contains("The trailer dictionary doesn't contain ID")), "{found:?}");
}
