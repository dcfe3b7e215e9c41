#include <nlohmann/json.hpp>

#include <exception>
#include <iostream>

// json_at POINTER: prints, in one line, the value at a JSON pointer (RFC 6901) of the JSON on the input.
int main(int argc, char** argv)
{
  if (argc != 2) return 2;
  try {
    std::cout << nlohmann::json::parse(std::cin).at(nlohmann::json::json_pointer(argv[1])).dump() << '\n';
    return 0;
  } catch (const std::exception& e) {
    std::cerr << "json_at: " << e.what() << '\n';
    return 1;
  }
}
