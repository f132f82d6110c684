// Error messages apart from their language, as the engine sends them (src/swirl/run/message.hpp).

/** A value of a sentence: a number, a text that is the same in each language, words to choose from,
 *  each in a line, or a phrase. */
export type SentenceValue = number | string | {words: string} | Sentence[];
export interface Sentence {
    code: string;
    values: Record<string, SentenceValue>;
}
/** An error message in English, with an optional hint in a second line, and its sentences for other
 *  languages. A text of the page itself has none. */
export interface Message {
    text: string;
    sentences: Sentence[];
}
