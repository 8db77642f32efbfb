within ContactMultiBody.UsersGuide;
class ToolNotes "Notes on Modelica tools"
  extends Modelica.Icons.Information;
  annotation (DocumentationClass=true, Documentation(info="<html>
<h4>All tools</h4>
<p>
The ContactManager calls the contact engine by <code>external \"C\"</code>. Header and library have to lie in the package's folders Resources/Include and
Resources/Library/&lt;platform&gt;, where the build of the project installs them; a release brings them along for linux64, win64 (for GCC, that is MinGW-w64) and aarch64-linux-gnu, and the engine's sources with a note how to build them in Resources/Source. Models of
<a href=\"modelica://ContactMultiBody.PureModelica\">PureModelica</a> need neither.
</p>
<p>
The engine is one static library, libContactMultiBody.a, that a C compiler links and that needs nothing but the C library. FCL, libccd and coal, which
<a href=\"modelica://ContactMultiBody.Types.Backend\">Backend</a> names, are modules beside it that are loaded when a scene names them: from the folders of the environment variable
<code>CMB_MODULE_PATH</code>, from the folder of the binary that holds the engine, or from where the system looks for libraries. For models that name one set
<code>CMB_MODULE_PATH</code> to the package's folder Resources/Library/linux64 before you start the tool. FMUs of <code>cmb fmu</code> bring along what their model names.
</p>
<p>
Geometry is not drawn: tools animate what MultiBody animates, boxes and cylinders of <a href=\"modelica://ContactMultiBody.Parts.BodyBox\">BodyBox</a> and
<a href=\"modelica://ContactMultiBody.Parts.BodyCylinder\">BodyCylinder</a>, spheres of other bodies, FreeBody among them. Connect a Modelica.Mechanics.MultiBody.Visualizers.FixedShape to a frame to see its
shape, and set <code>animateGround=true</code> in the world to see a floor at z = 0.
</p>
<h4>OpenModelica</h4>
<ul>
<li><code>make test-omc</code> checks and simulates all examples with <code>omc</code>, where it is installed. Version 1.28 was run so with the Standard Library 4.1.0; with 4.0.0
BallOnFloor, HammerOnAnvil and NewtonCradle were simulated: their trajectories agree with the same references.</li>
<li>Its FMUs for co-simulation integrate by explicit Euler at the communication step unless told otherwise, which diverges on stiff contact: export with
<code>--fmiFlags=s:cvode</code>. Also then they look for events at the communication points alone. Without restitution by events the references hold (BallWithoutEvents, SlidingBlock, SpinningSphere at 3 ms);
impacts that events catch are met late: the ball of BallOnFloor, 4.429 m/s fast, strikes with 3.637 m/s at steps of 1 ms, 4.409 at 0.1 ms, 4.4294 at 0.01 ms. For co-simulation take
<code>restitutionMethod=Memoryless</code>, steps of a hundredth of an impact's duration, or an FMU of <code>cmb fmu</code>; for model exchange its FMUs are right as they are.</li>
<li>For FMUs take <a href=\"modelica://ContactMultiBody.Parts.FreeBody\">FreeBody</a> instead of Body, and of BodyBox, BodyCylinder and BodyShape, for bodies that no joint holds, as the examples and generated models do; simulation in the tool takes either.
With Body, initialization of its FMUs ends with <code>wrong pose: body 1 has a rotation that is a reflection</code>. The cause is the solver of nonlinear systems in its FMUs, found in version 1.28:
where the start values of a system solve it already, it returns its own working vector, zeros at the first call, as the solution. The quaternion's unit length is such a system, and the start values of
Body solve it. Other start values do not help: a second system with the same unknowns follows and starts from the solution of the first. FreeBody has no such system. <code>useQuaternions=false</code> of Body also avoids it, but its angles have an attitude in which they fail.
<code>make test-omc-fmu</code> exports the examples and compares them with their references.</li>
<li>Variables that users read are results of functions, as <a href=\"modelica://ContactMultiBody.Internal.Unaliased\">Unaliased</a> explains; follow its rules in models of your own that call
functions of arrays. Impact speeds of version 1.28 are right with this library; earlier states of it gave the speed of the first impact for all.</li>
<li>In a manager of one pair, a variable of yours that is <code>-contacts.distance[1]</code>, or the negative of <code>approachSpeed[1]</code> or <code>normalForce[1]</code>, ends the
translation with <code>SimCodeUtil.createEquationsForSystems failed</code>: it takes the place of the function's result. Write what is not merely a negated variable,
<code>penetration = max(-contacts.distance[1], 0)</code>, or <code>ContactMultiBody.Internal.Unaliased.scalar(-contacts.distance[1])</code>.</li>
<li>It drops, <strong>without a message</strong>, modifiers of elements of a record that its declaration gives as a whole. Materials and inertias of a manager are such records, they are those of
its colliders: write <code>material={ball.material,floor.material}</code> or <code>collider={...}</code>, not <code>material(restitution={0.3,0.3})</code>. Materials of
<a href=\"modelica://ContactMultiBody.Parts.FreeBodies\">FreeBodies</a> and of bodies are not given so, and take either.</li>
<li>Messages <code>Solving non-linear system failed</code> at level debug in a run that ends well are attempts that were repeated with other states of a quaternion; FreeBody has none.</li>
<li>Scenes of <a href=\"modelica://ContactMultiBody.Parts.FreeBodies\">FreeBodies</a>: DASSL computes a Jacobian with as many evaluations as there are states, 13 a body, and does so every few steps. Where
contacts are as soft as in <a href=\"modelica://ContactMultiBody.Examples.SpheresInBox\">SpheresInBox</a> an explicit method is 15 times as fast; the annotation <code>__OpenModelica_simulationFlags(s=\"gbode\", gbm=\"dopri45\")</code> of
that example and of <a href=\"modelica://ContactMultiBody.Examples.SpheresOnFloor\">SpheresOnFloor</a> chooses it. Translation takes time with the square of the number of bodies and more, by its analysis of the initial system and of the Jacobian, in
which every force depends on every body: 7, 17 and 81 s of processor time for 20, 40 and 100.</li>
<li>It warns that <code>loadResource</code>, which generated models call for files of hulls, contains an impure call. The file's name is a parameter that is evaluated once, at translation or
initialization; nothing has to be done. The function is that of the ModelicaServices that come with the tool: another one does not resolve <code>modelica://</code>.</li>
<li>Static libraries export into FMUs more reliably than shared ones.</li>
</ul>
<h4>Dymola</h4>
<ul>
<li>File &gt; Open &gt; Load the file package.mo; or put the package's folder into a folder of <code>MODELICAPATH</code>, where libraryinfo.mos enters it into File &gt; Libraries.</li>
<li>On Windows choose GCC (MinGW-w64, 64 bit) in Simulation &gt; Setup &gt; Compiler: the engine is an archive of GCC, which Visual C++ cannot link. On Linux GCC is what Dymola takes.</li>
<li>Solver Dassl, Radau IIa or Cvode at tolerance 1e-6. For an export with a solver inside choose Cvode.</li>
</ul>
<h4>SimulationX</h4>
<ul>
<li>Add the folder that holds the package to the Modelica libraries (Extras &gt; Options &gt; Directories).</li>
<li>The compiler has to be GCC (MinGW-w64, 64 bit), as above; BDF or CVODE as solver, with events.</li>
</ul>
<h4>Wolfram System Modeler</h4>
<ul>
<li>File &gt; Open the file package.mo; or put the package into a folder of Tools &gt; Options &gt; Libraries.</li>
<li>On Windows choose MinGW as compiler; solver DASSL or CVODES.</li>
</ul>
<h4>Modelon Impact</h4>
<ul>
<li>Import the package as a project or library of the workspace. It computes on Linux and takes linux64; solver CVode, for which it exports an FMU for model exchange.</li>
<li>Modules of other back ends are found if <code>CMB_MODULE_PATH</code> is set in the environment of the server; the engine itself needs nothing.</li>
</ul>
<p>
These four follow their documentation and the rules that <a href=\"modelica://ContactMultiBody.Internal.Unaliased\">Unaliased</a> states: the library has been run in OpenModelica and by the built-in builder. <strong>Every tool</strong>
has to call functions with <code>external \"C\"</code> and arrays of Strings, give <code>each</code> and nested records of parameters, and find <code>Library</code> and <code>Include</code> below Resources; nothing else is asked for. Models of
<a href=\"modelica://ContactMultiBody.PureModelica\">PureModelica</a> need none of it.
</p>
<h4>rumoca and the built-in FMU builder</h4>
<ul>
<li>Classes that extend ExternalObject are not translated, hence the Integer handle of a scene.</li>
<li>rumoca 0.10.2 leaves some redeclarations of components out without a word: modifiers in <code>constrainedby</code> clauses, modifiers of a replaceable declaration where an element
redeclares it, and <code>extends Base(redeclare ...)</code> where the component comes from a class that Base extends. The FMU builder finds these and more, and refuses the model with the place and what to write instead:
modifiers with the redeclaration or in a class of its own, redeclarations one <code>extends</code> away from the declaration.</li>
<li>A modifier that gives some fields of a record takes the value from it that a modifier further in gave, <code>floor(material(restitution=0.4))</code> in a model that extends one with
<code>floor(material=Materials.Steel())</code>. The FMU builder refuses that: give the whole record, <code>material=Materials.Steel(restitution=0.4)</code>. Fields of a manager's materials beside <code>collider={...}</code> are taken.</li>
<li>Lists of colliders, geometries, materials or inertias in another order than the connected frames are refused. Other tools see that only where a Ground or a Fixed is involved, see
<a href=\"modelica://ContactMultiBody.Parts.Collider\">Collider</a>.</li>
<li>Long vertex lists of <a href=\"modelica://ContactMultiBody.Shapes.hull\">hull</a> are better given as one literal descriptor string.</li>
</ul>
</html>"));
end ToolNotes;
