#ifndef CGAL_CRUDE_REGISTRATION_FUZZ_READERS_H
#define CGAL_CRUDE_REGISTRATION_FUZZ_READERS_H

#include <cstddef>
#include <cstdint>

// Any bytes as a PLY file with a range grid: an image, or an IO_error. What was read is written and read again.
int run_read_range_image(const std::uint8_t* data, std::size_t size);

// The first byte says the format, the others are the file: a scan, which is written moved, or an IO_error.
int run_read_scan(const std::uint8_t* data, std::size_t size);

#endif // CGAL_CRUDE_REGISTRATION_FUZZ_READERS_H
