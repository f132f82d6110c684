// The few words of the first page.
import {dish as de} from "../texts/texts.de.json";
import {dish as en} from "../texts/texts.en.json";
import {language} from "../texts/start";

export const words: typeof en = language === "de" ? de : en;

/** Where the average rotation of a number of discs points; "still" if it is not distinguishable
 *  from zero. */
export type Way = "with" | "against" | "still";
