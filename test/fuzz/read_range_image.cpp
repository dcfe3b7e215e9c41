// Target of libFuzzer: see readers.h.

#include "readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  return run_read_range_image(data, size);
}
