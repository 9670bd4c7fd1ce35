// Nothing: the library of the headers that tests share needs a source.
