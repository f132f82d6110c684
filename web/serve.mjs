// Serves one page on this machine, to this machine.  node serve.mjs PAGE PORT yes|no
import {createServer} from "node:http";
import {readFile} from "node:fs/promises";
import {spawn} from "node:child_process";

const [page, port, browser] = process.argv.slice(2);
const server = createServer(async (request, answer) => {
    const path = new URL(request.url, "http://localhost").pathname;
    if (path !== "/" && path !== "/index.html") {
        answer.writeHead(404, {"content-type": "text/plain"}).end("There is only one page here: /\n");
        return;
    }
    try {
        answer.writeHead(200, {"content-type": "text/html; charset=utf-8"}).end(await readFile(page));
    } catch {
        answer.writeHead(500).end("The page is gone; start swirl lab again.\n");
    }
});
server.on("error", (error) => {
    const why = error.code === "EADDRINUSE"
        ? `Port ${port} is taken; another --port would be right.`
        : error.code === "EACCES" ? `Port ${port} is not for you; one above 1023 would be right.`
        : error.message;
    console.error(`swirl: ${why}`);
    process.exit(1);
});
server.listen(Number(port), "127.0.0.1", () => {
    const address = `http://localhost:${port}/`;
    console.log(`${address}  (Ctrl-C ends it)`);
    if (browser !== "yes" || !(process.env.DISPLAY || process.env.WAYLAND_DISPLAY)) return;
    spawn("xdg-open", [address], {stdio: "ignore", detached: true}).on("error", () => {}).unref();
});
for (const signal of ["SIGINT", "SIGTERM"]) process.on(signal, () => process.exit(130));
