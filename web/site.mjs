// The static site: README and docs as pages, the laboratory, the commands' help, and the sources
// that they point to.   node site.mjs ROOT OUT HELP_FOLDER NOTEBOOK_FOLDER [REPORT_FOLDER]
//
// NOTEBOOK_FOLDER holds notebooks with what they print; one that is not there is shown without.
//
// A link of a document to a file of the repository becomes a link to a page of that file, so nothing
// points out of the site but what names another. A link to what does not exist is an error.
import {cpSync, existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync} from "node:fs";
import {basename, dirname, extname, join, posix, resolve} from "node:path";
import markdownIt from "markdown-it";
import anchor from "markdown-it-anchor";

const [root, out, help, executed, report] = process.argv.slice(2).map((path) => resolve(path));
const pages = new Set(); // files of the repository that have a page, relative to its root
const waiting = []; // that still need one
const markdown = markdownIt({html: true}).use(anchor, {
    slugify: (text) => text.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, "").trim().replace(/ /g, "-"),
});

const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
const titles = {parameters: "Parameters", measurements: "Measurements", paper: "The paper, regenerated",
                physics: "Physics", spheres: "Spheres that roll", camera: "From a film", pictures: "Pictures and movies",
                lab: "The laboratory", python: "Python", python_reference: "Python: reference",
                files: "Files", determinism: "The same bits everywhere",
                performance: "Performance", "explanation/reliability": "Reliability", "explanation/architecture": "Architecture"};
const nameOf = (file) => file.replace(/^docs\//, "").replace(/\.md$/, "");
const documents = readdirSync(join(root, "docs"), {recursive: true}).filter((name) => name.endsWith(".md"))
    .map(nameOf)
    .sort((a, b) => Object.keys(titles).indexOf(a) - Object.keys(titles).indexOf(b));

/** Where in the site the page of a file of the repository is. */
function placeOf(file) {
    if (file === "README.md") return "index.html";
    const at = statSync(join(root, file));
    if (at.isDirectory()) return posix.join(file, "index.html");
    if (file.endsWith(".md")) return file.replace(/\.md$/, ".html");
    return [".png", ".gif", ".svg", ".mp4", ".webm"].includes(extname(file)) ? file : `${file}.html`;
}

function need(file) {
    if (pages.has(file)) return;
    pages.add(file);
    waiting.push(file);
}

/** The address of a link in `from`, a file of the repository, as seen from that file's page. */
function linked(href, from) {
    if (/^[a-z]+:/i.test(href) || href.startsWith("#")) return href;
    const [path, fragment] = href.split("#");
    const file = posix.normalize(posix.join(posix.dirname(from), path)).replace(/\/$/, "");
    if (file.startsWith("..") || !existsSync(join(root, file)))
        throw new Error(`${from} points to ${href}, which does not exist.`);
    return address(file, from) + (fragment ? `#${fragment}` : "");
}
/** Of the page of one file, as seen from that of another. */
function address(file, from) {
    need(file);
    return posix.relative(posix.dirname(placeOf(from)), placeOf(file));
}

function write(place, title, body) {
    const up = posix.relative(posix.dirname(place), ".") || ".";
    const links = [["index.html", "swirl"], ["lab.html", "Laboratory"], ["gallery.html", "Gallery"],
                   ["commands.html", "Commands"],
                   ...documents.map((name) => [`docs/${name}.html`, titles[name] ?? name]),
                   ...(report ? [["report/report.html", "Report"]] : [])];
    const navigation = links.map(([to, text]) => `<a href="${up}/${to}"${
        to === place ? ' aria-current="page"' : ""}>${escaped(text)}</a>`).join("\n");
    mkdirSync(dirname(join(out, place)), {recursive: true});
    writeFileSync(join(out, place), `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escaped(title)}</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${up}/site.css">
</head>
<body>
<nav aria-label="Pages">
${navigation}
</nav>
<main>
${body}
</main>
</body>
</html>
`);
}

function rendered(file, text = readFileSync(join(root, file), "utf-8")) {
    const tokens = markdown.parse(text, {});
    for (const token of tokens.flatMap((each) => each.children ?? [])) {
        for (const name of ["href", "src"]) {
            const value = token.attrGet?.(name);
            if (value) token.attrSet(name, linked(value, file));
        }
    }
    return markdown.renderer.render(tokens, markdown.options, {})
        .replace(/<table>/g, '<div class="wide"><table>').replace(/<\/table>/g, "</table></div>");
}

const joined = (text) => [text].flat().join("");

/** The richest of the forms in which a notebook holds what a cell printed. */
function printed({output_type, text, data}) {
    if (output_type === "stream") return `<pre>${escaped(joined(text))}</pre>`;
    if (data["image/svg+xml"]) return `<figure>${joined(data["image/svg+xml"])}</figure>`;
    if (data["image/png"])
        return `<figure><img src="data:image/png;base64,${joined(data["image/png"]).trim()}"
    alt="what the cell above draws"></figure>`;
    if (data["text/html"]) return `<div class="wide">${joined(data["text/html"])}</div>`;
    return `<pre>${escaped(joined(data["text/plain"]))}</pre>`;
}

function notebook(file) {
    const run = join(executed, basename(file));
    const {cells} = JSON.parse(readFileSync(existsSync(run) ? run : join(root, file), "utf-8"));
    return cells.map(({cell_type, source, outputs}) =>
        cell_type === "markdown" ? rendered(file, joined(source))
            : `<pre class="source"><code>${escaped(joined(source))}</code></pre>\n` +
              outputs.map((output) => printed(output)).join("\n")).join("\n");
}

function pageOf(file) {
    const place = placeOf(file), from = join(root, file);
    if (statSync(from).isDirectory()) {
        const names = readdirSync(from).filter((name) => !name.startsWith(".") &&
            !["node_modules", "generated", "build", "__pycache__"].includes(name));
        const rows = names.map((name) =>
            `<li><a href="${address(posix.join(file, name), file)}">${escaped(name)}</a></li>`);
        write(place, file, `<h1>${escaped(file)}</h1>\n<ul>\n${rows.join("\n")}\n</ul>`);
    } else if (file.endsWith(".md")) {
        let body = rendered(file);
        if (file === "README.md")
            body = body.replace(/<h2/, `<h2 id="laboratory">Try it</h2>
<iframe src="lab.html?discs=48" title="The laboratory" loading="lazy"></iframe>
<p><a href="lab.html">The laboratory on a page of its own</a></p>\n<h2`);
        write(place, file === "README.md" ? "swirl: marbles in a swirled dish"
            : titles[nameOf(file)] ?? file, body);
    } else if (file.endsWith(".ipynb")) {
        write(place, file, notebook(file));
    } else if (place === file) {
        mkdirSync(dirname(join(out, file)), {recursive: true});
        cpSync(from, join(out, file));
    } else {
        const text = readFileSync(from, "utf-8").replace(/\n$/, "");
        const lines = text.split("\n").map((line, k) => `<span id="L${k + 1}">${escaped(line)}</span>`);
        write(place, file, `<h1>${escaped(file)}</h1>\n<pre class="source"><code>${lines.join("\n")}</code></pre>`);
    }
}

/** What was made of web/gallery.txt, or stands in docs/, with the sentence and the command. */
function gallery() {
    const shown = readFileSync(join(root, "web/gallery.txt"), "utf-8").split("\n")
        .filter((line) => line && !line.startsWith("#")).map((line) => line.split(" | "))
        .map(([caption, command, kept]) =>
            ({caption, command, kept, from: kept ?? `gallery/${command.match(/--out (\S+)/)[1]}`}))
        .filter(({kept, from}) => kept || existsSync(join(out, from)));
    for (const {kept} of shown) if (kept) linked(kept, "README.md"); // and so it comes along
    write("gallery.html", "Gallery", "<h1>Gallery</h1>\n" + shown.map(({caption, command, from}) => {
        const picture = from.endsWith(".mp4")
            ? `<video src="${from}" controls loop muted playsinline preload="metadata"></video>`
            : `<img src="${from}" alt="${escaped(caption)}" loading="lazy">`;
        return `<figure>\n${picture}\n<figcaption>${escaped(caption)}\n` +
            `<pre><code>./${escaped(command)}</code></pre></figcaption>\n</figure>`;
    }).join("\n"));
}

mkdirSync(out, {recursive: true});
cpSync(join(root, "web/site.css"), join(out, "site.css"));
if (report) cpSync(report, join(out, "report"), {recursive: true});
need("README.md");
for (const name of documents) need(`docs/${name}.md`);
gallery();
while (waiting.length > 0) pageOf(waiting.shift());

const commands = readdirSync(help).filter((name) => name.endsWith(".txt")).map((name) => basename(name, ".txt"))
    .sort((a, b) => (a === "swirl" ? -1 : b === "swirl" ? 1 : a < b ? -1 : 1));
write("commands.html", "Commands", `<h1>Commands</h1>
<ul>${commands.map((name) => `<li><a href="#${name}">${name === "swirl" ? "swirl" : `swirl ${name}`}</a></li>`).join("")}</ul>
${commands.map((name) => `<h2 id="${name}">${name === "swirl" ? "swirl" : `swirl ${name}`}</h2>
<pre><code>${escaped(readFileSync(join(help, `${name}.txt`), "utf-8"))}</code></pre>`).join("\n")}`);
console.log(`${pages.size + 1} pages and pictures`);
