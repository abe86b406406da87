// Looks at lcm-spy from within, as a Java agent of the very process that a user starts: waits until it has decoded
// every channel expected, opens one, clicks on its curves, takes a picture, and reports the results.
//
// Argument: FOLDER,CHANNEL,CHANNEL... The first channel's fields are shown and plotted. FOLDER/spy.png is the picture,
// FOLDER/spy.txt the result: a line for each channel, then "plotted POINTS PIXELS". No spy.txt if something is missing.
import info.monitorenter.gui.chart.Chart2D;
import info.monitorenter.gui.chart.ITrace2D;
import java.awt.Component;
import java.awt.Container;
import java.awt.Rectangle;
import java.awt.Robot;
import java.awt.Toolkit;
import java.awt.Window;
import java.awt.event.MouseEvent;
import java.awt.image.BufferedImage;
import java.io.File;
import java.lang.reflect.Field;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.function.Supplier;
import javax.imageio.ImageIO;
import javax.swing.JTable;
import javax.swing.SwingUtilities;
import lcm.spy.ObjectPanel;

public final class SpyWatch {
    private static final int POINTS = 120; // of a curve, before it is evaluated
    private static final String[] CURVES = {"position_mm", "velocity_mm_per_s"};

    private SpyWatch() {}

    public static void premain(String argument) {
        List<String> words = Arrays.asList(argument.split(","));
        Thread thread = new Thread(() -> watch(Path.of(words.get(0)), words.subList(1, words.size())));
        thread.setDaemon(true);
        thread.start();
    }

    private static void watch(Path folder, List<String> channels) {
        try {
            JTable table = await(() -> first(all(JTable.class)));
            List<String> seen = await(() -> decoded(table, channels));
            await(() -> place(table, 0, 0, 1280, 200));
            ObjectPanel fields = open(table, channels.get(0));
            List<Chart2D> charts = new ArrayList<>();
            for (String curve : CURVES) {
                charts.add(openChart(fields, curve, 200 + 280 * charts.size()));
            }
            for (Chart2D chart : charts) {
                seen.add("plotted " + await(() -> points(chart)) + " " + curvePixels(chart));
            }
            takePicture(folder.resolve("spy.png").toFile());
            Path unfinished = folder.resolve("spy.txt.part");
            Files.write(unfinished, seen);
            Files.move(unfinished, folder.resolve("spy.txt"));
        } catch (Exception failure) {
            failure.printStackTrace();
        }
    }

    /** Asks repeatedly on Swing's own thread until there is an answer. The script ends the process if none comes. */
    private static <T> T await(Supplier<T> question) throws Exception {
        ArrayList<T> answer = new ArrayList<>();
        while (true) {
            SwingUtilities.invokeAndWait(() -> answer.add(question.get()));
            T last = answer.remove(0);
            if (last != null) {
                return last;
            }
            Thread.sleep(100);
        }
    }

    /** Every component of this class in any window. */
    private static <T extends Component> List<T> all(Class<T> type) {
        List<T> found = new ArrayList<>();
        for (Window window : Window.getWindows()) {
            collect(window, type, found);
        }
        return found;
    }

    private static <T> T first(List<T> list) {
        return list.isEmpty() ? null : list.get(0);
    }

    private static <T extends Component> void collect(Component at, Class<T> type, List<T> found) {
        if (type.isInstance(at)) {
            found.add(type.cast(at));
        }
        if (at instanceof Container) {
            for (Component child : ((Container) at).getComponents()) {
                collect(child, type, found);
            }
        }
    }

    /**
     * Every channel as "NAME TYPE UNDECODABLE", once all are there; null before. To be called before a window opens:
     * lcm-spy also counts messages as undecodable that come while it opens one.
     */
    private static List<String> decoded(JTable table, List<String> channels) {
        List<String> lines = new ArrayList<>();
        for (String channel : channels) {
            int row = rowOf(table, channel);
            if (row < 0) {
                return null;
            }
            lines.add(channel + " " + cell(table, row, "Type") + " " + cell(table, row, "Undecodable"));
        }
        return lines;
    }

    private static int rowOf(JTable table, String channel) {
        for (int row = 0; row < table.getRowCount(); row++) {
            if (cell(table, row, "Channel").equals(channel)) {
                return row;
            }
        }
        return -1;
    }

    private static String cell(JTable table, int row, String column) {
        return String.valueOf(table.getValueAt(row, table.getColumn(column).getModelIndex())).trim();
    }

    private static ObjectPanel open(JTable table, String channel) throws Exception {
        await(() -> {
            Rectangle cell = table.getCellRect(rowOf(table, channel), 0, true);
            return click(table, cell.x + 5, cell.y + cell.height / 2, MouseEvent.BUTTON1, 2);
        });
        ObjectPanel fields = await(() -> first(all(ObjectPanel.class)));
        await(() -> place(fields, 0, 200, 640, 560));
        return fields;
    }

    /** A click with the middle button on a field's curve opens its chart in a separate window. */
    private static Chart2D openChart(ObjectPanel fields, String field, int y) throws Exception {
        int middle = await(() -> middleOfCurve(fields, field));
        List<Chart2D> before = await(() -> all(Chart2D.class));
        await(() -> click(fields, fields.getWidth() - 60, middle, MouseEvent.BUTTON2, 1));
        Chart2D chart = await(() -> {
            List<Chart2D> opened = all(Chart2D.class);
            opened.removeAll(before);
            return first(opened);
        });
        await(() -> place(chart, 640, y, 640, 280));
        return chart;
    }

    /** Where the curve was drawn last, from private fields of the panel; null if it was not drawn yet. */
    private static Integer middleOfCurve(ObjectPanel fields, String field) {
        try {
            for (Object curve : (List<?>) read(fields, "visibleSparklines")) {
                if (read(curve, "name").equals(field)) {
                    return ((Integer) read(curve, "ymin") + (Integer) read(curve, "ymax")) / 2;
                }
            }
            return null;
        } catch (ReflectiveOperationException failure) {
            throw new IllegalStateException(failure);
        }
    }

    private static Object read(Object from, String name) throws ReflectiveOperationException {
        Field field = from.getClass().getDeclaredField(name);
        field.setAccessible(true);
        return field.get(from);
    }

    private static boolean place(Component part, int x, int y, int width, int height) {
        Window window = SwingUtilities.getWindowAncestor(part);
        window.setBounds(x, y, width, height);
        window.validate();
        return true;
    }

    private static boolean click(Component where, int x, int y, int button, int times) {
        for (int kind : new int[] {MouseEvent.MOUSE_PRESSED, MouseEvent.MOUSE_RELEASED, MouseEvent.MOUSE_CLICKED}) {
            where.dispatchEvent(new MouseEvent(where, kind, System.currentTimeMillis(), 0, x, y, times, false, button));
        }
        return true;
    }

    private static Integer points(Chart2D chart) {
        int points = 0;
        for (ITrace2D trace : chart.getTraces()) {
            points += trace.getSize();
        }
        return points >= POINTS ? points : null;
    }

    /** Pixels of the chart as it is drawn now that have its curve's colour. */
    private static int curvePixels(Chart2D chart) throws Exception {
        return await(() -> {
            BufferedImage image = new BufferedImage(chart.getWidth(), chart.getHeight(), BufferedImage.TYPE_INT_RGB);
            chart.paint(image.getGraphics());
            int colour = chart.getTraces().first().getColor().getRGB();
            int pixels = 0;
            for (int y = 0; y < image.getHeight(); y++) {
                for (int x = 0; x < image.getWidth(); x++) {
                    pixels += image.getRGB(x, y) == colour ? 1 : 0;
                }
            }
            return pixels;
        });
    }

    private static void takePicture(File file) throws Exception {
        Rectangle screen = new Rectangle(Toolkit.getDefaultToolkit().getScreenSize());
        ImageIO.write(new Robot().createScreenCapture(screen), "png", file);
    }
}
