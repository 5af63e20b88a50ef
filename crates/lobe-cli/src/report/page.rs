//! The page: one HTML file that needs no other, for light and dark, wide and narrow, screen and paper.

use super::checks::Check;
use super::furnace::SIDE;
use super::materials::{BALL, LobeFacts, MaterialFacts, SHOWN};
use super::pictures::{Between, Picture};
use super::sampling;
use super::trade::{BUDGET, EFFORT, Trade};
use super::{Facts, Plot};
use crate::plot::svg::{data_uri, escape, label, style};
use crate::plot::{front, pareto_panel};
use crate::trade::{Choice, KINDS, dots, machine, short, what};
use lobe_trade::Row;
use std::fmt::Write as _;

const CSS: &str = "\
:root{color-scheme:light dark;--paper:#fff;--card:#f6f7f8;--ink:#1d2126;--soft:#5d6570;--line:#dde1e6;--link:#0060a8;\
--good:#0b6b3a;--good-back:#e3f4ea;--bad:#9c1c1c;--bad-back:#fbe6e4}\
@media (prefers-color-scheme:dark){:root{--paper:#16181c;--card:#1e2126;--ink:#e4e7eb;--soft:#9aa3ae;--line:#343941;\
--link:#7cbcf5;--good:#7bd7a4;--good-back:#173425;--bad:#ff9d94;--bad-back:#42201e}}\
*{box-sizing:border-box}html{-webkit-text-size-adjust:100%}\
body{margin:0;background:var(--paper);color:var(--ink);line-height:1.55;\
font-family:system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif;overflow-wrap:break-word}\
header,main,footer{max-width:1120px;margin:0 auto;padding:0 20px}\
header{padding-top:36px}h1{font-size:1.9rem;line-height:1.2;margin:0 0 6px;letter-spacing:-.01em}\
h2{font-size:1.35rem;margin:52px 0 6px;padding-top:10px}h3{font-size:1.02rem;margin:0 0 4px}\
p{margin:6px 0 14px;max-width:72ch}.soft{color:var(--soft)}\
nav{display:flex;flex-wrap:wrap;gap:4px 18px;margin:14px 0 22px;font-size:.95rem}a{color:var(--link)}\
figure{margin:0}img{display:block;width:100%;height:auto;border-radius:8px;background:var(--card)}\
figcaption{color:var(--soft);font-size:.93rem;margin-top:8px;max-width:72ch}\
figcaption b{color:var(--ink);font-weight:600}\
button{font:inherit;color:inherit;background:none;border:0;padding:0;margin:0;text-align:inherit;cursor:pointer}\
:focus-visible{outline:2px solid var(--link);outline-offset:2px}\
button.open{display:block;width:100%;cursor:zoom-in}\
dialog{border:0;padding:12px;border-radius:10px;background:var(--paper);color:var(--ink);max-width:96vw;max-height:96vh;\
cursor:zoom-out}dialog::backdrop{background:rgba(0,0,0,.72)}\
dialog img,dialog svg{display:block;width:auto;min-width:min(90vw,900px);max-width:92vw;max-height:92vh;object-fit:contain}\
.grid{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,440px),1fr));gap:30px 28px;margin-top:18px}\
.plot{border:1px solid var(--line);border-radius:8px;padding:14px 14px 16px;background:var(--paper)}\
.plot svg{display:block;width:100%;height:auto;margin:6px 0;max-height:600px}\
.whole{grid-column:1/-1;overflow-x:auto}.whole svg{min-width:720px}\
.small{grid-template-columns:repeat(auto-fill,minmax(min(100%,230px),1fr));gap:16px}.small figcaption{font-size:.86rem}\
.scroll{overflow-x:auto;margin:12px 0 6px;border:1px solid var(--line);border-radius:8px}\
table{border-collapse:collapse;width:100%;font-size:.92rem}\
th,td{text-align:left;vertical-align:top;padding:8px 14px;border-bottom:1px solid var(--line)}\
tbody tr:last-child td,tbody tr:last-child th{border-bottom:0}\
thead th{font-weight:600;color:var(--soft);background:var(--card);white-space:nowrap}\
tbody th{font-weight:600;white-space:nowrap}\
th[aria-sort] button::after{content:' ▴'}th[aria-sort=descending] button::after{content:' ▾'}\
td.ball img{width:64px;height:64px;min-width:64px}td.ball button.open{width:64px}\
ul.why{margin:6px 0 0;padding-left:18px;color:var(--soft);font-size:.88rem}\
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}\
td.where{min-width:52ch;font-size:.85rem;color:var(--soft)}td.verdict{min-width:24ch}td.lobes{min-width:32ch}#materials th,#materials td{padding:8px 10px}#materials thead th.n{white-space:normal;min-width:8ch}\
#materials tbody th{white-space:normal;min-width:14ch;overflow-wrap:anywhere}\
code{font-family:ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;font-size:.9em}\
pre{background:var(--card);border:1px solid var(--line);border-radius:8px;padding:12px 14px;overflow-x:auto;margin:10px 0}\
.tag{display:inline-block;font-size:.8rem;font-weight:600;border-radius:99px;padding:1px 10px;white-space:nowrap}\
.good{color:var(--good);background:var(--good-back)}.bad{color:var(--bad);background:var(--bad-back)}\
.swatch{display:inline-block;width:.9em;height:.9em;border-radius:3px;border:1px solid var(--line);\
vertical-align:-.1em;margin-right:6px}\
.trade .scroll{margin:12px 0 8px}.trade th,.trade td{padding:5px 9px}summary{cursor:pointer;font-size:.93rem}\
.check{margin:26px 0}.check td{white-space:nowrap}.check td.where{white-space:normal}.check h3 .tag{margin-left:8px}\
dl{display:grid;grid-template-columns:max-content 1fr;gap:4px 22px;margin:12px 0}dt{color:var(--soft)}dd{margin:0}\
footer{padding-top:34px;padding-bottom:48px;color:var(--soft);font-size:.9rem}\
@media (max-width:600px){header,main,footer{padding-left:16px;padding-right:16px}h1{font-size:1.55rem}\
.plot{padding:10px 8px 14px}th,td{padding:7px 10px}}\
@media print{:root{--paper:#fff;--card:#f6f7f8;--ink:#000;--soft:#444;--line:#bbb;--link:#000;--good:#000;--bad:#000;\
--good-back:#fff;--bad-back:#fff}nav,dialog{display:none}th[aria-sort] button::after{content:''}.grid{display:block}figure,.check,tr{break-inside:avoid}\
.plot,figure{margin-bottom:18px}.scroll{overflow:visible}h2{break-after:avoid}}";

/// Sorts the tables, and opens pictures large. Without it the page has all that it has.
const SCRIPT: &str = include_str!("page.js");

/// A PNG file as an element.
fn picture_element(png: &[u8], (width, height): (u32, u32), alt: &str) -> String {
    format!("<img width=\"{width}\" height=\"{height}\" alt=\"{}\" src=\"{}\">", escape(alt), data_uri(png))
}

/// The page.
pub(crate) fn html(facts: &Facts, plots: &[Plot]) -> String {
    let mut page = String::new();
    let title = match facts.scene.source.as_str() {
        "built-in" => "lobe: the built-in scene".to_owned(),
        source => format!("lobe: {source}"),
    };
    let _ = write!(
        page,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n\
         <style>{CSS}{}</style>\n</head>\n<body>\n",
        escape(&title),
        style()
    );
    header(&mut page, facts, &title);
    page.push_str("<main>\n");
    views(&mut page, &facts.views);
    between(&mut page, &facts.between);
    lobes(&mut page, plots);
    materials(&mut page, &facts.materials);
    samples(&mut page, &facts.materials);
    checks(&mut page, &facts.checks);
    if let Some(measured) = &facts.trade {
        trade(&mut page, measured);
    }
    warnings(&mut page, &facts.warnings);
    run(&mut page, facts);
    let _ = write!(
        page,
        "</main>\n<footer>Made by lobe {}. The same facts for programs: <code>report.json</code>.</footer>\n\
         <script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        facts.version
    );
    page
}

fn header(page: &mut String, facts: &Facts, title: &str) {
    let broken = facts.checks.iter().filter(|check| !check.holds).count();
    let gaining = facts.materials.iter().filter(|material| material.gains_energy).count();
    let checks = match broken {
        0 => format!("{} All {} checks hold.", tag(true, "holds"), facts.checks.len()),
        1 => format!("{} 1 of {} checks does not hold.", tag(false, "broken"), facts.checks.len()),
        _ => format!("{} {broken} of {} checks do not hold.", tag(false, "broken"), facts.checks.len()),
    };
    let energy = match gaining {
        0 => "every material conserves energy".to_owned(),
        1 => "1 material gains energy".to_owned(),
        _ => format!("{gaining} materials gain energy"),
    };
    let _ = write!(
        page,
        "<header>\n<h1>{}</h1>\n<p>{} triangles, {} materials, {} views. {checks} Of the materials, {energy}.</p>\n\
         <nav aria-label=\"Sections\"><a href=\"#views\">Views</a><a href=\"#between\">Light between surfaces</a><a href=\"#lobes\">Lobes</a>\
         <a href=\"#materials\">Materials</a>{}<a href=\"#checks\">Checks</a>{}<a href=\"#warnings\">Warnings</a>\
         <a href=\"#run\">This run</a></nav>\n</header>\n",
        escape(title),
        facts.scene.triangles,
        facts.materials.len(),
        facts.views.len(),
        if has_samples(&facts.materials) { "<a href=\"#samples\">Samples</a>" } else { "" },
        if facts.trade.is_some() { "<a href=\"#trade\">What digits cost</a>" } else { "" }
    );
}

fn tag(good: bool, text: &str) -> String {
    format!("<span class=\"tag {}\">{}</span>", if good { "good" } else { "bad" }, escape(text))
}

/// A text of ours in which `code` stands between backticks.
fn prose(text: &str) -> String {
    let mut out = String::new();
    for (index, part) in text.split('`').enumerate() {
        let part = escape(part);
        if index % 2 == 1 {
            let _ = write!(out, "<code>{part}</code>");
        } else {
            out.push_str(&part);
        }
    }
    out
}

fn views(page: &mut String, pictures: &[Picture]) {
    page.push_str("<section id=\"views\">\n");
    for (index, picture) in pictures.iter().enumerate() {
        if index == 1 {
            page.push_str("<h2>The views</h2>\n<div class=\"grid\">\n");
        }
        let _ = writeln!(
            page,
            "<figure>{}<figcaption><b>{}</b>. {}</figcaption></figure>",
            picture_element(
                &picture.png,
                (picture.width, picture.height),
                &format!("The view {}. {}", picture.name, picture.caption)
            ),
            escape(&picture.name),
            prose(&picture.caption)
        );
    }
    page.push_str(if pictures.len() > 1 { "</div>\n</section>\n" } else { "</section>\n" });
}

fn between(page: &mut String, Between { cast, traced, .. }: &Between) {
    page.push_str(
        "<section id=\"between\">\n<h2>Light between surfaces</h2>\n<p>The first view twice: by rays, as above, and by paths, which go \
         on from surface to surface, each time in a direction that is drawn from the lobes of the material there.</p>\n\
         <div class=\"grid\">\n",
    );
    for (picture, by, of) in [(cast, "rays", "rays"), (traced, "paths", "paths")] {
        let _ = writeln!(
            page,
            "<figure>{}<figcaption><b>By {by}</b>: {} {of} a pixel, {:.2} s. {}</figcaption></figure>",
            picture_element(
                &picture.png,
                (picture.width, picture.height),
                &format!("The view {} by {by}. {}", picture.name, picture.caption)
            ),
            picture.samples,
            picture.seconds,
            prose(&picture.caption)
        );
    }
    page.push_str("</div>\n</section>\n");
}

fn lobes(page: &mut String, plots: &[Plot]) {
    page.push_str(
        "<section id=\"lobes\">\n<h2>The lobes</h2>\n<p>How much light goes where: the distance from the point that is lit, \
         or the height over the angle, is the value.</p>\n<div class=\"grid\">\n",
    );
    for plot in plots {
        let _ = write!(
            page,
            "<figure class=\"plot{}\"><h3>{}</h3>\n{}<figcaption>{}</figcaption></figure>\n",
            if plot.wide { " whole" } else { "" },
            escape(&plot.title),
            plot.svg.inline(),
            prose(&plot.caption)
        );
    }
    page.push_str("</div>\n</section>\n");
}

fn materials(page: &mut String, materials: &[MaterialFacts]) {
    page.push_str(
        "<section id=\"materials\">\n<h2>The materials</h2>\n<p>The directional albedo is what one sees of a uniform white world \
         from that angle, measured from the normal; the largest of red, green and blue is shown. Above 1 a surface sends out \
         more than it receives. The verdict also looks at it the other way round, at the part of the light from one direction \
         that is reflected anywhere: for a BRDF that is the same, for the lecture's highlights it is not. Each sphere is lit from the upper left, and a little from the right. \
         The furnace is the same sphere in a world that is equally bright everywhere: what reflects all that arrives vanishes there, \
         what loses light is dark, what gains it bright.</p>\n\
         <div class=\"scroll\"><table>\n<thead><tr><th>sphere</th><th>furnace</th><th>material</th><th>lobes and parameters</th>",
    );
    for angle in SHOWN {
        let _ = write!(page, "<th class=\"n\">albedo {angle}°</th>");
    }
    page.push_str("<th>energy</th></tr></thead>\n<tbody>\n");
    for material in materials {
        let lobes: Vec<String> = material.lobes.iter().map(lobe).collect();
        let lobes = if lobes.is_empty() { "none".to_owned() } else { lobes.join("<br>") };
        let _ = write!(
            page,
            "<tr><td class=\"ball\">{}</td><td class=\"ball\">{}</td><th scope=\"row\">{}</th><td class=\"lobes\">{lobes}{}{}</td>",
            ball(material),
            in_furnace(material),
            escape(&material.name),
            extras(material),
            why(&material.reasons)
        );
        for index in 0..SHOWN.len() {
            let text = match material.albedo.get(index) {
                Some(rgb) => format!("{:.3}", rgb.iter().fold(0.0_f64, |max, &x| max.max(x))),
                None => "–".to_owned(),
            };
            let _ = write!(page, "<td class=\"n\">{text}</td>");
        }
        let verdict = prose(&material.verdict);
        let verdict = if material.gains_energy { format!("{} {verdict}", tag(false, "warning")) } else { verdict };
        let _ = writeln!(page, "<td class=\"verdict\">{verdict}</td></tr>");
    }
    page.push_str("</tbody></table></div>\n</section>\n");
}

/// A page of hundreds of small pictures is no page.
const MOST_SAMPLED: usize = 32;

fn has_samples(materials: &[MaterialFacts]) -> bool {
    materials.iter().any(|material| material.sampling.is_some())
}

/// What is drawn from each material.
fn samples(page: &mut String, materials: &[MaterialFacts]) {
    if !has_samples(materials) {
        return;
    }
    let sampled: Vec<_> =
        materials.iter().filter_map(|material| Some((material, material.sampling.as_ref()?))).collect();
    let left_out = match sampled.len().saturating_sub(MOST_SAMPLED) {
        0 => String::new(),
        1 => " 1 more material is not shown.".to_owned(),
        more => format!(" {more} more materials are not shown."),
    };
    let _ = write!(
        page,
        "<section id=\"samples\">\n<h2>The samples</h2>\n<p>Where paths go on from each material, for a viewer at 45°: the hemisphere \
         from above, the viewer as the black or white dot to the right. The colour is what is reflected of the light from there, the lobe with its \
         cosine, bright at its peak and darkest {} decades below. Each orange dot is one of {} directions that were drawn: \
         they should be where it is bright.</p>\n<p>The variance is that of one sample in a white world, relative to the square of what \
         is reflected, and beside it that of directions in proportion to the cosine: ten times the variance needs ten times the samples for the \
         same noise. Rejected are samples below the horizon. The numbers are of {} samples.{left_out}</p>\n<div class=\"grid small\">\n",
        sampling::DECADES,
        sampling::SHOWN,
        sampling::DRAWN
    );
    for (material, sampling) in sampled.into_iter().take(MOST_SAMPLED) {
        let by_cosine = match sampling.relative_variance_by_cosine {
            Some(variance) => format!("by the cosine {}", short_variance(variance)),
            None => "by the cosine without bound".to_owned(),
        };
        let mirror = if material.lobes.iter().any(|lobe| lobe.model == "mirror") {
            " Its mirror, of one direction, is not among them."
        } else {
            ""
        };
        let _ = writeln!(
            page,
            "<figure class=\"plot\"><h3>{}</h3>\n{}<figcaption>Variance <b>{}</b>, {by_cosine}; {} rejected.{mirror}</figcaption></figure>",
            escape(&material.name),
            sampling.svg.inline(),
            short_variance(sampling.relative_variance),
            percent(sampling.rejected)
        );
    }
    page.push_str("</div>\n</section>\n");
}

/// Two digits, or that it is hardly there.
fn short_variance(variance: f64) -> String {
    match variance {
        x if x < 1e-3 => "below 0.001".to_owned(),
        x if x < 0.1 => format!("{x:.3}"),
        x if x < 10.0 => format!("{x:.2}"),
        x => format!("{x:.0}"),
    }
}

fn percent(part: f64) -> String {
    match part {
        0.0 => "none".to_owned(),
        x if x < 1e-3 => "below 0.1 %".to_owned(),
        x => format!("{:.1} %", 100.0 * x),
    }
}

fn ball(material: &MaterialFacts) -> String {
    match &material.ball {
        Some(png) => picture_element(png, (BALL, BALL), &format!("A sphere of {}", material.name)),
        None => String::new(),
    }
}

fn in_furnace(material: &MaterialFacts) -> String {
    match &material.furnace {
        Some(png) => picture_element(png, (SIDE, SIDE), &format!("A sphere of {} in a white world", material.name)),
        None => String::new(),
    }
}

fn why(reasons: &[String]) -> String {
    if reasons.is_empty() {
        return String::new();
    }
    let items: Vec<_> = reasons.iter().map(|reason| format!("<li>{}</li>", prose(reason))).collect();
    format!("<ul class=\"why\">{}</ul>", items.concat())
}

fn lobe(lobe: &LobeFacts) -> String {
    let mut text = String::new();
    if let Some(rgb) = lobe.reflectance {
        // A browser wants the curve of sRGB.
        let [r, g, b] = rgb.map(|x| (lobe_scene::image::srgb(x.clamp(0.0, 1.0)) * 255.0).round() as u8);
        let _ = write!(text, "<span class=\"swatch\" style=\"background:rgb({r},{g},{b})\"></span>");
    }
    let _ = write!(text, "<code>{}</code>", escape(&lobe.model));
    let name = if lobe.model == "lambert" { "albedo" } else { "ks" };
    if let Some(rgb) = lobe.reflectance {
        let _ = write!(text, " {name} {}", colour(rgb));
    }
    if let Some(q) = lobe.exponent {
        let _ = write!(text, ", q {q}");
    }
    if !lobe.parameters.is_empty() {
        let _ = write!(text, ", {}", escape(&lobe.parameters));
    }
    text
}

fn colour(rgb: [f32; 3]) -> String {
    let short = |x: f32| {
        let text = format!("{x:.3}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    };
    let [r, g, b] = rgb;
    if r == g && g == b { short(r) } else { format!("({}, {}, {})", short(r), short(g), short(b)) }
}

/// What a material has beside its lobes.
fn extras(material: &MaterialFacts) -> String {
    let mut text = String::new();
    if !material.views.is_empty() {
        let _ = write!(text, "<br><span class=\"soft\">in the view {}</span>", escape(&material.views.join(", ")));
    }
    if material.ambient != [0.0; 3] {
        let _ = write!(text, "<br><span class=\"soft\">ambient {}</span>", colour(material.ambient));
    }
    if material.emission != [0.0; 3] {
        let _ = write!(text, "<br><span class=\"soft\">emits {}</span>", colour(material.emission));
    }
    if material.dissolve < 1.0 {
        let _ = write!(text, "<br><span class=\"soft\">dissolve {}</span>", material.dissolve);
    }
    text
}

fn checks(page: &mut String, checks: &[Check]) {
    page.push_str(
        "<section id=\"checks\">\n<h2>The checks</h2>\n<p>What the mathematics promises, computed anew for this page, with \
         random directions that are the same in every run.</p>\n",
    );
    for check in checks {
        let verdict = if check.holds { tag(true, "holds") } else { tag(false, "broken") };
        let _ = write!(
            page,
            "<div class=\"check\"><h3>{} {verdict}</h3>\n<p>{} <span class=\"soft\">{}</span></p>\n\
             <div class=\"scroll\"><table><thead><tr>",
            escape(check.name),
            prose(check.promise),
            prose(&check.found)
        );
        for column in check.columns {
            let _ = write!(page, "<th>{}</th>", escape(column));
        }
        page.push_str("</tr></thead>\n<tbody>\n");
        for row in &check.rows {
            page.push_str("<tr>");
            for (index, cell) in row.iter().enumerate() {
                let cell = escape(cell);
                let _ = match (index, check.columns.get(index)) {
                    (0, _) => write!(page, "<th scope=\"row\"><code>{cell}</code></th>"),
                    (_, Some(&"worst at")) => write!(page, "<td class=\"where\">{cell}</td>"),
                    _ => write!(page, "<td>{cell}</td>"),
                };
            }
            page.push_str("</tr>\n");
        }
        page.push_str("</tbody></table></div></div>\n");
    }
    page.push_str("</section>\n");
}

/// What digits cost: for each material a plot, the rows that are worth it, and all of them.
fn trade(page: &mut String, measured: &Trade) {
    let left_out = match measured.left_out {
        0 => String::new(),
        1 => " 1 more material is left out.".to_owned(),
        more => format!(" {more} more materials are left out."),
    };
    let steady = if measured.noisy {
        let text =
            "The machine was too busy for these times to be trusted; run the report again when nothing else runs.";
        format!("{} {text}", tag(false, "noisy"))
    } else {
        "The times were steady.".to_owned()
    };
    let _ = write!(
        page,
        "<section id=\"trade\">\n<h2>What digits cost</h2>\n<p>Nanoseconds for one evaluation of each material, against its \
         error: with fewer digits, and with approximations in place of its parts, where it has some. The table has what is worth \
         it, the fastest first: no other row is both faster and nearer. Errors are relative, against f64, of 99 in 100 and the \
         worst; what is seen is the largest CIE ΔE 2000, and the largest difference of a channel in steps of eight bits, on a sphere under three \
         lights.</p>\n<p>Measured on: {}. {steady}</p>\n<p class=\"soft\">Only a little was measured: {}. A time is the median of \
         {} short runs from the cache; the errors are of {} pairs of directions and of a picture of {} pixels in a row.{left_out} \
         <code>lobe trade SCENE</code> measures every number type and level, from the cache, from memory and on all cores, \
         and more closely.</p>\n<div class=\"grid\">\n",
        escape(machine().trim_end()),
        escape(&measured.numbers),
        EFFORT.rounds,
        EFFORT.pairs,
        EFFORT.sphere
    );
    for rows in &measured.rows {
        let Some(first) = rows.first() else { continue };
        let dots = dots(rows);
        let best: Vec<&Row> = front(&dots).into_iter().filter_map(|index| rows.get(index)).collect();
        let choice = Choice::of(rows, BUDGET);
        let cheapest = match (choice.cheapest, choice.scalar) {
            (None, _) => "Nothing is within 1/255.".to_owned(),
            (Some(row), scalar) => {
                let time = |row: &Row| label(row.resident.median);
                let than = scalar.map_or(String::new(), |row| format!("; the scalar f32 takes {} ns", time(row)));
                format!("The cheapest within 1/255: <b>{}</b>, {} ns{than}.", escape(&what(row)), time(row))
            }
        };
        let _ = write!(
            page,
            "<figure class=\"plot trade\"><h3>{}</h3>\n{}<figcaption>{cheapest}</figcaption>\n",
            escape(&first.subject),
            pareto_panel(&first.subject, &dots, &KINDS).inline()
        );
        trade_table(page, best.into_iter());
        let _ = writeln!(page, "<details><summary>All {} rows</summary>", rows.len());
        trade_table(page, rows.iter());
        page.push_str("</details></figure>\n");
    }
    page.push_str("</div>\n</section>\n");
}

fn trade_table<'a>(page: &mut String, rows: impl Iterator<Item = &'a Row>) {
    page.push_str(
        "<div class=\"scroll\"><table><thead><tr><th>number</th><th>form</th><th class=\"n\">ns</th><th class=\"n\">99 %</th>\
         <th class=\"n\">worst</th><th class=\"n\">ΔE</th><th class=\"n\">8 bit</th></tr></thead>\n<tbody>\n",
    );
    for row in rows {
        let _ = writeln!(
            page,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>\
             <td class=\"n\">{:.2}</td><td class=\"n\">{}</td></tr>",
            escape(&row.number.name()),
            escape(&row.form),
            label(row.resident.median),
            short(row.error.p99),
            short(row.error.worst),
            row.seen.worst,
            row.seen.steps
        );
    }
    page.push_str("</tbody></table></div>\n");
}

fn warnings(page: &mut String, warnings: &[String]) {
    page.push_str("<section id=\"warnings\">\n<h2>Warnings</h2>\n");
    if warnings.is_empty() {
        page.push_str("<p>None: everything in the files was understood.</p>\n");
    } else {
        page.push_str("<ul>\n");
        for warning in warnings {
            let _ = writeln!(page, "<li>{}</li>", prose(warning));
        }
        page.push_str("</ul>\n");
    }
    page.push_str("</section>\n");
}

fn run(page: &mut String, facts: &Facts) {
    let (scene, seconds) = (&facts.scene, &facts.seconds);
    let samples = facts.views.first().map_or(0, |view| view.samples);
    let _ = write!(
        page,
        "<section id=\"run\">\n<h2>This run</h2>\n<p>The same report again:</p>\n<pre><code>{}</code></pre>\n<dl>\n\
         <dt>scene</dt><dd>{}: {} triangles in {} meshes</dd>\n<dt>reading</dt><dd>{:.2} s</dd>\n\
         <dt>pictures</dt><dd>{:.2} s, {samples} rays a pixel</dd>\n<dt>paths</dt><dd>{:.2} s</dd>\n<dt>albedos</dt><dd>{:.2} s</dd>\n\
         <dt>checks</dt><dd>{:.2} s</dd>\n<dt>times</dt><dd>{:.2} s</dd>\n<dt>in all</dt><dd>{:.2} s</dd>\n<dt>version</dt><dd>lobe {}</dd>\n</dl>\n\
         </section>\n",
        escape(&facts.command),
        escape(&scene.source),
        scene.triangles,
        scene.meshes,
        seconds.load,
        seconds.render,
        seconds.paths,
        seconds.energy,
        seconds.checks,
        seconds.trade,
        seconds.total,
        facts.version
    );
}
