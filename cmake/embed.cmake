# cmake -DOUT=FILE.cpp -DNAMES="style;script" -Dstyle="a.css;b.css" -Dscript="a.js;b.js" -P embed.cmake: writes the texts of files, one
# after another, as std::string_view into namespace pintle::page_parts, declared in HEADER (framework/report/page_parts.h).
if(NOT HEADER)
  set(HEADER framework/report/page_parts.h)
endif()
set(text "#include \"${HEADER}\"\n\nnamespace pintle::page_parts {\n\n")
foreach(name IN LISTS NAMES)
  set(bytes "")
  foreach(file IN LISTS ${name})
    file(READ "${file}" hex HEX)
    string(REGEX REPLACE "(..)" "0x\\1," hex "${hex}")
    string(APPEND bytes "${hex}0x0a,")
  endforeach()
  string(APPEND text "static const unsigned char ${name}_bytes[] = {${bytes}};\n"
    "const std::string_view ${name}{reinterpret_cast<const char*>(${name}_bytes), sizeof ${name}_bytes};\n\n")
endforeach()
file(WRITE "${OUT}" "${text}}  // namespace pintle::page_parts\n")
