declare module "*.wasm.gz?url" {
    const url: string;
    export default url;
}

declare module "jsfive" {
    export interface Dataset {
        shape: number[];
        value: ArrayLike<number | bigint | string>;
    }
    export interface Group {
        attrs: Record<string, unknown>;
        keys?: string[];
    }
    export class File {
        constructor(bytes: ArrayBuffer, name: string);
        get(path: string): Dataset & Group | undefined;
    }
}
