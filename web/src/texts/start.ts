// The start of the page: the query of its address, or the one that is written into the file. `swirl
// lab --discs 40 --out FILE` and Python's swirl.lab() write it, because a file that is embedded in
// a notebook has no address of its own.

/** Entries of the query that are not parameters of a run. */
const ofThePage = ["lang", "embed", "lesson", "class", "beside", "view", "color", "strobe"];

const entriesOf = (query: string): [string, string][] => [...new URLSearchParams(query)];
const hasPage = typeof document !== "undefined";
const address = hasPage ? entriesOf(location.search) : [];
const written = hasPage
    ? entriesOf(document.querySelector<HTMLMetaElement>('meta[name="swirl-start"]')?.content ?? "")
    : [];

/** The parameters among the entries, with underscores in their names; those of the address replace
 *  those of the file. Names that are not known, such as those that other sites add to a link, are
 *  ignored. */
export function startParameters(isKnown: (name: string) => boolean): [string, string][] {
    const [own, ofFile] = [address, written].map((entries) =>
        entries
            .map(([name, value]): [string, string] => [name.replaceAll("-", "_"), value])
            .filter(([name]) => isKnown(name)),
    );
    return own!.length > 0 ? own! : ofFile!;
}

/** The other entries of the page's own address. */
export const pageEntries: Record<string, string> = Object.fromEntries(
    address.filter(([name]) => ofThePage.includes(name)),
);
/** Sets one of them for later addresses, or removes it. */
export function setPageEntry(name: string, value: string | undefined): void {
    if (value === undefined) delete pageEntries[name];
    else pageEntries[name] = value;
}
/** Such an entry of the address or of the file. */
export const pageEntry = (name: string): string | null =>
    pageEntries[name] ?? written.find(([each]) => each === name)?.[1] ?? null;

/** Whether the page shows the container and its main controls only. */
export const isEmbedded = (): boolean => pageEntry("embed") === "1";

/** The first supported language of the address and of the browser. */
export function languageOf(wanted: string | null, preferred: readonly string[]): "en" | "de" {
    for (const each of wanted ? [wanted] : preferred) {
        const language = each.toLowerCase().split("-")[0];
        if (language === "de" || language === "en") return language;
    }
    return "en";
}

/** Workers get the language as their name. */
export const language: "en" | "de" =
    typeof document === "undefined"
        ? languageOf((globalThis as {name?: string}).name || null, [])
        : languageOf(pageEntry("lang"), navigator.languages);
