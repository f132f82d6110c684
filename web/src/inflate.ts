// The decompression of HDF5 chunks; jsfive's own library is five times as large.
export {unzlibSync as inflate} from "fflate";
