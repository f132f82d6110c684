// The rotation rate in units of Ω, averaged in blocks. A block is one period at first. In a long
// run the engine merges neighbouring blocks, so that their number stays bounded.
import type {Rotation} from "./engine";

/** The last period of each block. */
export function periodsOf(rotation: Rotation): number[] {
    const {
        blocks,
        warmup,
        warmup_blocks: early,
        periods_per_block: [before, after],
    } = rotation;
    return blocks.map((_, k) => (k < early ? (k + 1) * before : warmup + (k + 1 - early) * after));
}

/** The mean over the blocks so far, for each block; the warm-up has none. */
export function meansOf({blocks, warmup_blocks: early}: Rotation): (number | null)[] {
    let sum = 0;
    return blocks.map((block, k) => (k < early ? null : (sum += block ?? 0) / (k - early + 1)));
}

export function tableOf(rotation: Rotation | undefined): string {
    const periods = rotation ? periodsOf(rotation) : [];
    return (
        "period,varpi,varpi_rigid\n" +
        periods
            .map(
                (period, k) =>
                    `${period},${rotation!.blocks[k] ?? ""},${rotation!.rigid_blocks[k] ?? ""}\n`,
            )
            .join("")
    );
}
