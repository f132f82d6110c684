// Serves both pages of a folder on the loopback interface: node serve.mjs FOLDER PORT yes|no QUERY.
// The third argument says whether to open a browser, the last one is the query of the address that
// is shown; it may be empty.
import {createServer} from "node:http";
import {readFile} from "node:fs/promises";
import {join} from "node:path";
import {spawn} from "node:child_process";

const [folder, port, browser, query = ""] = process.argv.slice(2);
const pages = new Map([
    ["/", "index.html"],
    ["/index.html", "index.html"],
    ["/laboratory.html", "laboratory.html"],
]);
// Only these names are accepted as Host: a foreign page whose name resolves to this machine (DNS
// rebinding) sends its own name.
const hosts = ["localhost", "127.0.0.1", "[::1]"].flatMap((name) =>
    Number(port) === 80 ? [name, `${name}:80`] : [`${name}:${port}`],
);

const plain = (status, text, more = {}) => ({
    status,
    headers: {"content-type": "text/plain", ...more},
    body: text,
});

/** The target is compared without decoding, and never used as a file name. */
async function answerTo({method, url, headers}) {
    if (!hosts.includes((headers.host ?? "").toLowerCase()))
        return plain(403, "This server answers requests to localhost only.\n");
    if (method !== "GET" && method !== "HEAD")
        return plain(405, "This server answers GET and HEAD only.\n", {allow: "GET, HEAD"});
    if (!/^\/(?![/\\])/.test(url)) return plain(400, "The request names no path of this server.\n");
    const page = pages.get(url.split("?", 1)[0]);
    if (!page) return plain(404, "The pages of this server are / and /laboratory.html\n");
    try {
        const body = await readFile(join(folder, page));
        return {status: 200, headers: {"content-type": "text/html; charset=utf-8"}, body};
    } catch {
        return plain(500, "The page cannot be read. Restart swirl lab.\n");
    }
}

// From version 20 on, Node.js itself would reject requests without a Host, with another status.
const server = createServer({requireHostHeader: false}, async (request, response) => {
    const {status, headers, body} = await answerTo(request);
    response
        .writeHead(status, {
            ...headers,
            "content-length": Buffer.byteLength(body),
            "x-content-type-options": "nosniff",
        })
        .end(body);
});
server.on("error", (error) => {
    const why =
        error.code === "EADDRINUSE"
            ? `port ${port} is already in use. Choose another --port.`
            : error.code === "EACCES"
              ? `no permission for port ${port}. Choose a --port above 1023.`
              : error.message;
    console.error(`error: ${why}`);
    process.exit(1);
});
server.listen(Number(port), "127.0.0.1", () => {
    const address = `http://localhost:${port}/${query && `?${query}`}`;
    console.log(`${address}  (Ctrl-C stops the server)`);
    if (browser !== "yes" || !(process.env.DISPLAY || process.env.WAYLAND_DISPLAY)) return;
    spawn("xdg-open", [address], {stdio: "ignore", detached: true})
        .on("error", () => {})
        .unref();
});
for (const signal of ["SIGINT", "SIGTERM"]) process.on(signal, () => process.exit(130));
