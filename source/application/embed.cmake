# cmake -DFILES="a.prm;b.prm" -DOUTPUT=x.cc -P embed.cmake: a C++ file with the contents of the files.
set(text "#include <tribodraw/application/verbs.h>\n\nnamespace tribodraw\n{\n  const std::vector<ShippedFile> &shipped_files()\n  {\n    static const std::vector<ShippedFile> files{\n")
separate_arguments(FILES)
list(SORT FILES)
foreach(file ${FILES})
  get_filename_component(name ${file} NAME_WE)
  # Not as list: a semicolon in a file would be lost.
  file(READ ${file} content)
  string(APPEND text "      {\"${name}\", R\"=====(${content})=====\"},\n")
endforeach()
string(APPEND text "    };\n    return files;\n  }\n} // namespace tribodraw\n")
file(WRITE ${OUTPUT} "${text}")
