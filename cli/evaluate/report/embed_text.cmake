# Writes text files as C++: cmake -DOUT=report_texts.cpp -DIN=report.html;report.css -P embed_text.cmake
# Each becomes the function of report_texts.h that is called as the file, with _ for dots.
set(code "#include \"cli/evaluate/report/report_texts.h\"\n")
foreach(file ${IN})
  get_filename_component(name ${file} NAME)
  string(REPLACE "." "_" name ${name})
  file(READ ${file} text)
  string(APPEND code "\nstd::string_view fbs::cli::${name}() {  // NOLINT(readability-function-size): a text\n  return R\"fbs(${text})fbs\";\n}\n")
endforeach()
file(WRITE ${OUT} "${code}")
