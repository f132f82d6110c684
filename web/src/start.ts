// The start of the page: the query of its address, or the one that is written into the file.
// `swirl lab --discs 40 --out FILE` and Python's swirl.lab() write it, because a file that is embedded in a
// notebook has no address of its own.

/** Entries of the query that are not parameters of a run. */
const ofThePage = ["lang", "embed"];

export function startQuery(): URLSearchParams {
    if (typeof document === "undefined") return new URLSearchParams();
    const written = document.querySelector<HTMLMetaElement>('meta[name="swirl-start"]')?.content ?? "";
    const query = new URLSearchParams(written);
    // An address with parameters replaces those of the file.
    const own = new URLSearchParams(location.search);
    if ([...own.keys()].some((name) => !ofThePage.includes(name)))
        for (const name of [...query.keys()]) if (!ofThePage.includes(name)) query.delete(name);
    for (const [name, value] of own) query.set(name, value);
    return query;
}

/** The parameters among them; names are written with underscores. */
export function startParameters(): [string, string][] {
    return [...startQuery()].filter(([name]) => !ofThePage.includes(name))
        .map(([name, value]) => [name.replaceAll("-", "_"), value]);
}

/** The other entries of the page's own address. */
export function pageEntries(): Record<string, string> {
    return Object.fromEntries([...new URLSearchParams(location.search)].filter(([name]) => ofThePage.includes(name)));
}

/** Whether the page shows the container and its main controls only. */
export const isEmbedded = (): boolean => startQuery().get("embed") === "1";

/** The first supported language of the address and of the browser. */
export function languageOf(wanted: string | null, preferred: readonly string[]): "en" | "de" {
    for (const each of wanted ? [wanted] : preferred) {
        const language = each.toLowerCase().split("-")[0];
        if (language === "de" || language === "en") return language;
    }
    return "en";
}

/** Workers get the language as their name. */
export const language: "en" | "de" = typeof document === "undefined"
    ? languageOf((globalThis as {name?: string}).name || null, [])
    : languageOf(startQuery().get("lang"), navigator.languages);
