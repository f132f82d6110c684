// The symbols and commands of the page, the same in every language.
import optionOfKey from "./option_of_key.json";

/** As in the paper. */
export const symbols = {
    rotation: "ϖ/Ω",
    rotationM: "ϖ_M/Ω",
    theta: "θ",
    discs: "N",
    friction: "μ",
    crossing: "N_c",
    // Points: the centre of the path, the centre of the container, the point of the wall farthest
    // from S.
    swirl: "S",
    container: "C",
    farthest: "M",
};

/** Command lines, which are the same in every language. */
export const commands = {
    run: (options: string): string => `./swirl run ${options}`,
    crossing: (options: string): string => `./swirl crossing ${options}`,
    sweep: (options: string, folder: string): string =>
        `./swirl sweep ${options} --out ${folder} && ./swirl collect ${folder}`,
};

/** A page of the documentation in the folder of the sources. */
export const documentIn = (page: string): string => `docs/${page}.md`;

/** Parameters whose option has another name than their key (tests/run/nearest_name_test.cpp writes
 *  them). */
const optionsOfKeys: Record<string, string> = optionOfKey;

/** "--mu-disc" for the key of a parameter. */
export const optionOf = (key: string): string =>
    `--${(optionsOfKeys[key] ?? key).replaceAll("_", "-")}`;

/** The key of a parameter for its option without hyphens at the start. */
export const keyOf = (option: string): string => {
    const name = option.replaceAll("-", "_");
    return Object.keys(optionsOfKeys).find((key) => optionsOfKeys[key] === name) ?? name;
};

/** A message with the names of fields instead of options; within a sentence they begin with a small
 *  letter if `isEnglish`. */
export const labelled = (
    message: string,
    labels: Record<string, string>,
    isEnglish = true,
): string =>
    message.replace(/--([a-z-]+)/g, (option, name: string, at: number) => {
        const label = labels[keyOf(name)],
            begins = at === 0 || message[at - 1] === "\n";
        return !label
            ? option
            : begins || !isEnglish
              ? label
              : label[0]!.toLowerCase() + label.slice(1);
    });
