<?xml version="1.0" encoding="UTF-8"?>
<AdapterType Name="Plug" Comment="Connects two"><InterfaceList><InputVars><VarDeclaration Name="in" Type="BOOL"/></InputVars></InterfaceList></AdapterType>
