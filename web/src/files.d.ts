declare module "*.wasm.gz?url" {
    const url: string;
    export default url;
}
