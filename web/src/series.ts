// The rigid-body rate in Ω, block for block: a block is a swirl at first, and in a long run several, since the engine puts
// neighbours together so that their number stays bounded.
import type {Rotation} from "./engine";

/** The last swirl of every block. */
export function swirlsOf(rotation: Rotation): number[] {
    const {blocks, warmup, warmup_blocks: early, swirls_per_block: [before, after]} = rotation;
    return blocks.map((_, k) => k < early ? (k + 1) * before : warmup + (k + 1 - early) * after);
}

/** Of the blocks so far, for each of them; the warm-up has none. */
export function meansOf({blocks, warmup_blocks: early}: Rotation): (number | null)[] {
    let sum = 0;
    return blocks.map((block, k) => k < early ? null : (sum += block ?? 0) / (k - early + 1));
}

export function tableOf(rotation: Rotation | undefined): string {
    const swirls = rotation ? swirlsOf(rotation) : [];
    return "swirl,varpi_rigid\n" + swirls.map((swirl, k) => `${swirl},${rotation!.blocks[k] ?? ""}\n`).join("");
}
